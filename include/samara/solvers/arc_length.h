#ifndef samara_solvers_arc_length_h
#define samara_solvers_arc_length_h

#include <samara/solvers/newton.h>

#include <functional>

namespace samara
{
  /** An equilibrium on a path, with the direction in which the path goes on from there. */
  struct PathPoint
  {
    State               state;
    std::vector<double> tangent;        ///< dζ/ds: nodal twists, joint coordinates, multipliers
    double              slope      = 0; ///< of the load factor, d factor/ds
    int                 sign       = 0; ///< of the determinant of the tangent matrix
    unsigned int        iterations = 0; ///< that were needed to find it
    double              cosine = 1; ///< of the larger angle between the step that led here and the tangents at its ends
    double              condition = 1; ///< reciprocal condition number of the tangent matrix
  };



  /**
   * Equilibrium paths with the load factor as an unknown: the arc-length method of Riks and Crisfield, with
   * consistently linearised constraint.
   *
   * The distance of two configurations is measured in the coordinates themselves, where it is quadratic as all else:
   *
   *     s² = 1/N Σ (|x − x₀|²/L² + ½ |D − D₀|²) + w² (f − f₀)²
   *
   * over the N nodes but the ground, L the size of the model, f the load factor; ½ |D − D₀|² = 2 (1 − cos φ), φ the
   * angle between two triads. Multipliers are not in it. w = 0 is the cylindrical constraint, w > 0 the spherical one.
   * A step starts along the tangent of the path and ends at the equilibrium at the distance s, by mixed Newton
   * iterations on all unknowns and f with one factorisation of the tangent matrix and two solutions each.
   *
   * Sources: Riks, IJSS 15 (1979) 529–551; Crisfield, Computers & Structures 13 (1981) 55–62; doc/theory/statics.md.
   */
  class ArcLength
  {
  public:
    ArcLength(const System &system,
              LinearSolver &solver,
              double        load_weight    = 0,
              double        tolerance      = 1e-9,
              unsigned int  max_iterations = 30);

    /** Find the tangent of an equilibrium; the load factor grows along it. @throws SingularMatrix */
    void start(PathPoint &point);

    /** From @p from forward to the equilibrium at the distance @p s > 0, with its tangent. */
    NewtonResult step(const PathPoint &from, double s, PathPoint &to);

    /**
     * The point between @p from and the one at the distance @p s where @p function is zero; it has the values @p
     * at_start and @p at_end, of opposite signs, there. By regula falsi (Illinois), until it is below @p precision of
     * the larger of the two. Returns the distance; negative if a step fails.
     */
    double locate(const PathPoint                                &from,
                  double                                          s,
                  double                                          at_start,
                  double                                          at_end,
                  double                                          precision,
                  const std::function<double(const PathPoint &)> &function,
                  PathPoint                                      &found);

    /** The same where the determinant changes its sign, by bisection to @p precision of s. */
    double locate_change_of_sign(const PathPoint &from, double s, double precision, PathPoint &found);

    unsigned int n_iterations = 0; ///< of all steps, for reports

  private:
    const System       &system;
    LinearSolver       &solver;
    const double        weight, tolerance;
    const unsigned int  max_iterations;
    const double        length; // of the model
    SparseMatrix        K;
    std::vector<double> stress, residual, load, gradient, increment;

    double distance_squared(const State &state, const State &base) const;

    /** Derivative of half of it with respect to the unknowns. */
    void find_gradient(const State &state, const State &base, std::vector<double> &g) const;

    /** Minus the derivative of the residual with respect to the load factor, on which it depends linearly. */
    void find_load(const State &state);

    /** |dζ| in the sense of the distance. */
    double norm(const std::vector<double> &z) const;

    void factorize(const State &state);

    /**
     * One iteration for the point at the distance @p s: the increment of all unknowns; returns that of the load factor.
     */
    double solve_for_increment(const PathPoint &from, double s, const State &state);

    /** Newton's method from @p to, with the tangent where it ends. @throws SingularMatrix */
    void iterate(const PathPoint &from, double s, PathPoint &to, NewtonResult &result);

    /** With the tangent matrix factorised; forward is away from @p behind. */
    void find_tangent(PathPoint &point, const PathPoint *behind);
  };
} // namespace samara

#endif

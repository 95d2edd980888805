#ifndef samara_time_rival_parts_h
#define samara_time_rival_parts_h

#include <samara/solvers/linear.h>
#include <samara/time/integrator.h>

#include <utility>

namespace samara
{
  /**
   * What the integrators of others have in common, which are here for comparison (doc/theory/rivals.md).
   *
   * Their accounts of energy: work of loads with a potential is what the potential loses; that of others, the work of
   * drives and the viscous loss are quadratures of the powers at the ends of the steps (of IDA's own steps for BDF).
   * `dissipated` is the energy that is missing then. It may be negative: they may gain energy.
   */
  namespace rivals
  {
    /** Turn and shift a node by the screw motion exp(z), z in the node's own frame [m, rad]. */
    void move(State &state, unsigned int node, const Vector6 &z);

    /** The increment δ with exp(z + δ) = exp(z) exp(ζ) for small ζ, up to terms of third order in z. */
    Vector6 change_of_exponent(const Vector6 &z, const Vector6 &zeta);

    /** Add a 6×6 matrix to the diagonal block of a node. */
    void add_to_node(SparseMatrix &A, const Layout &layout, unsigned int node, const Matrix6 &block);

    /** Rates of the constraints, G y + ∂g/∂t; zero for multipliers that are released or dropped. */
    std::vector<double> constraint_rates(const System &system, const State &state);

    /** Which multipliers are neither released nor dropped. */
    std::vector<bool> active_multipliers(const System &system);
    std::vector<bool> nonholonomic_multipliers(const System &system);

    /** Whether something prescribed has a corner within @p width of @p time. */
    bool is_corner(const System &system, double time, double width);

    /** Size of a change of velocities, each divided by the length of the model if it has metres in it. */
    class Measure
    {
    public:
      explicit Measure(const System &system);
      double largest(const std::vector<double> &y, const std::vector<double> &rates) const;

      const double length;

    private:
      const System &system;
    };

    /**
     * Newton's method with factors of an earlier step, as long as its corrections shrink fast. They are relative to the
     * largest velocity.
     */
    class Corrections
    {
    public:
      enum class Verdict
      {
        converged,
        go_on,
        again,   ///< from the start of the step, with new factors
        diverged ///< with new factors, too
      };

      /** @p slow: rate from one correction to the next above which each iteration has its own factors. */
      Corrections(const bool has_factors, const double slow, const double tolerance)
        : slow(slow)
        , tolerance(tolerance)
        , is_fresh(!has_factors)
        , is_missing(!has_factors)
      {}

      /** Whether the next iteration begins with a factorisation; asked once. */
      bool
      need_factors()
      {
        return std::exchange(is_missing, false);
      }

      Verdict judge(double size);

    private:
      const double slow, tolerance;
      bool         is_fresh, is_missing;
      double       last = 0;
    };

    /** Place of the largest of the first @p n numbers in absolute value. */
    unsigned int largest_of(const std::vector<double> &values, unsigned int n);

    /** Power of loads, drives and dampers [W], or their work [J]; of the air, which is part of that of the loads. */
    struct Powers
    {
      double    loads = 0, drives = 0, viscous = 0;
      WorkOfAir air = {};

      void
      add(const double factor, const Powers &of)
      {
        loads += factor * of.loads;
        drives += factor * of.drives;
        viscous += factor * of.viscous;
        air.add(factor, of.air);
      }
    };

    /** At a state with multipliers; loads with a potential do not count. */
    Powers powers(const System &system, const State &state);

    /** Fill the energies of a step: what is missing was dissipated. @p work: without loads that have a potential. */
    void account(const System &system, const State &before, const State &after, const Powers &work, StepResult &result);

    /** The same with the powers at both ends. */
    void account(const System &system, const State &before, const State &after, StepResult &result);



    /** A 2×2 block matrix of which each block has the pattern of the system. */
    class PairMatrix
    {
    public:
      explicit PairMatrix(const std::shared_ptr<const Pattern> &pattern);

      void clear();

      /** Value of the k-th entry in column j of block (row, column); @p k counts the entries of the system's pattern.
       */
      double &
      at(const unsigned int row, const unsigned int column, const int j, const int k)
      {
        const int start = single->column_start[j], length = single->column_start[j + 1] - start;
        return matrix.values[2 * (column * single->n_nonzeros() + start) + row * length + k - start];
      }

      /** Add @p function(row, column, k) of each entry of the system's pattern to a block. */
      template <typename Function>
      void
      add(const unsigned int row, const unsigned int column, const Function &function)
      {
        for (int j = 0; j < single->size(); ++j)
          for (int k = single->column_start[j]; k < single->column_start[j + 1]; ++k)
            at(row, column, j, k) += function(single->rows[k], j, k);
      }

      void
      factorize()
      {
        solver->factorize(matrix);
      }
      void
      solve(double *b) const
      {
        solver->solve(b);
      }

    private:
      std::shared_ptr<const Pattern> single;
      SparseMatrix                   matrix;
      std::unique_ptr<LinearSolver>  solver;
    };
  } // namespace rivals
} // namespace samara

#endif

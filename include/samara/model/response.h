#ifndef samara_model_response_h
#define samara_model_response_h

#include <samara/base/law.h>
#include <samara/model/signal.h>
#include <samara/model/system.h>

namespace samara
{
  /**
   * A law of a model's state, with its signals: a number ℓ(t, s_1, …, s_n) and what its derivatives do to matrices.
   *
   * Terms that have it in their residual, r = … + c ℓ with coefficients c that they know, leave to it the part of the
   * tangent that comes from the change of ℓ:
   *
   *     K += c (∂ℓ/∂q + ∂ℓ/∂y ad_y)        C += c ∂ℓ/∂y
   *
   * with ad_y as δy = ζ̇ + ad_y ζ of nodes.
   */
  class Response
  {
  public:
    /** Find the signals. @throws std::invalid_argument saying what is known, FollowUp */
    Response(const Law &law, Model &model);

    /** The response of a signal itself. */
    explicit Response(const SignalPointer &signal);

    /** The unknowns in whose rows @p c stands: twists of frames in their own axes, coordinates, states, multipliers. */
    struct Rows
    {
      std::vector<Frame>        frames;
      std::vector<unsigned int> coordinates, states, multipliers;
    };

    /** Whether it depends on nothing but time and states of first order. */
    bool is_of_states() const;

    /** To be called in Item::connect(); the frames of @p rows are resolved. It stays where it is from then on. */
    void connect(Layout &layout, const Rows &rows);

    template <typename Number>
    Number operator()(const Point<Number> &point) const;

    /** ∂ℓ/∂t + ∂ℓ/∂z ż, of a law of time and states. */
    double rate(const Point<double> &point) const;

    /** Where the law or a signal has a corner in time, see Law::next_corner(). */
    double next_corner(double from, double to) const;

    /** See Term::pieces(). */
    void pieces(const Point<double> &point, std::vector<double> &result) const;

    /** Add what belongs to the coefficients @p c of the rows: 6 a frame, coordinates, states, multipliers. */
    void add_tangent(const Point<double> &point, const Eigen::VectorXd &c, SparseMatrix &K) const;
    void add_damping(const Point<double> &point, const Eigen::VectorXd &c, SparseMatrix &C) const;

  private:
    Law                        law;
    std::vector<SignalPointer> signals;
    Block                      block;
    unsigned int               n_rows = 0; ///< coefficients

    std::vector<unsigned int>              row_places;    ///< in the block, of each coefficient
    std::vector<std::vector<unsigned int>> signal_places; ///< of the unknowns of each signal

    void couple(Layout &layout, const Rows &rows);

    /** Time and the signals' values, until the next call on this thread. */
    const double *variables(const Point<double> &point) const;

    template <bool by_velocity>
    void add(const Point<double> &point, const Eigen::VectorXd &c, SparseMatrix &A) const;
  };



  template <>
  double Response::operator()(const Point<double> &) const;
  template <>
  std::complex<double> Response::operator()(const Point<std::complex<double>> &) const;
} // namespace samara

#endif

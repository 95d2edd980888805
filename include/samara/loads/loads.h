#ifndef samara_loads_loads_h
#define samara_loads_loads_h

#include <samara/model/response.h>

#include <algorithm>
#include <array>

namespace samara
{
  /** The first time in (from, to) where any component has a corner, see ScalarFunction::next_corner(). */
  template <typename Function>
  double
  first_corner(const std::array<Function, 3> &f, const double from, const double to)
  {
    return std::min({f[0].next_corner(from, to), f[1].next_corner(from, to), f[2].next_corner(from, to)});
  }



  /**
   * The weight of everything: the inertia of each node times the acceleration of gravity. It has a potential if the
   * acceleration is constant; otherwise it does work as any load does.
   */
  class Gravity : public Item, public Evaluated<Gravity, Force>
  {
  public:
    void   add_parameters(Parameters &prm) override;
    void   initialize(Model &model) override;
    void   find_signals(Model &model) override;
    void   connect(Layout &layout) override;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    void   pieces(const Point<double> &point, std::vector<double> &result) const override;
    bool   has_potential() const override;
    double potential_energy(const Point<double> &point) const override;

    bool
    acts_on_whole_model() const override
    {
      return true;
    }

    /** The first corner of any component, see ScalarFunction::next_corner(). */
    double next_corner(double from, double to) const override;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

  private:
    std::array<Law, 3> acceleration{{Law(0.), Law(0.), Law(-9.80665)}};
    const Model       *model = nullptr;
    std::vector<Block> blocks; // of all nodes but the ground

    /** Of the components that depend on the model's state; null of others. */
    using Responses = std::array<std::unique_ptr<Response>, 3>;
    std::vector<Responses> responses; ///< of each node, as of blocks; empty if no component does

    template <typename Number>
    Vec3<Number> acceleration_at(const Point<Number> &point) const;

    /** What comes from the change of the acceleration. */
    void add_responses(const Point<double> &point, bool by_velocity, SparseMatrix &A) const;

    /** [m I; m c~] of a node: what has weight, without virtual mass. */
    Eigen::Matrix<double, 6, 3> weighed(unsigned int node) const;
    std::vector<Matrix6>        without_weight; ///< of each node, if there is any
  };



  /**
   * A force f and a moment m, at points or per length: what concentrated and distributed loads have in common. Dead
   * loads keep their direction in the inertial frame, followers in the frame they act on. A dead moment about a fixed
   * axis is not conservative.
   */
  class WrenchLoad : public Item, public Evaluated<WrenchLoad, Force>
  {
  public:
    void be_placed(const Placement &placement) override;
    void find_signals(Model &model) override;
    void connect(Layout &layout) override;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void damping(const Point<double> &point, SparseMatrix &C) const override;
    void pieces(const Point<double> &point, std::vector<double> &result) const override;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /** The first corner of any component of force and moment, see ScalarFunction::next_corner(). */
    double next_corner(double from, double to) const override;

  protected:
    void add_axes_parameter(Parameters &prm);

    bool
    is_follower() const
    {
      return axes == "body";
    }

    /** Of the components of force and moment that depend on the model's state; null of others. */
    using Responses = std::array<std::unique_ptr<Response>, 6>;

    /** weight f and weight m at a frame. */
    struct AtPoint
    {
      Frame     frame;
      double    weight; ///< of a dead line load ∫ N_a p ds, see LineLoad [m]
      Block     block     = {};
      Responses responses = {};
    };
    std::vector<AtPoint> points;

    /** A follower per length on a span: Σ_b products(a, b) D_b f at its frame a. */
    struct AlongSpan
    {
      std::vector<Frame> frames;
      Eigen::MatrixXd    products; ///< ∫ N_a N_b p ds, see LineLoad [m]
      Block              block     = {};
      Responses          responses = {};
    };
    std::vector<AlongSpan> spans;

    /** A part of a distributed load: ∫ N_a p and ∫ N_a N_b p of its frames. */
    void add_part(const std::vector<Frame> &frames, const Eigen::VectorXd &weights, const Eigen::MatrixXd &products);

    std::array<Law, 3> force, moment;

    /** Force and moment. */
    template <typename Number>
    Vec6<Number> wrench(const Point<Number> &point) const;

  private:
    std::string axes = "inertial";

    bool depends_on_state = false; ///< any component

    /** Of any part: laws have the same value at all of them, and other rows in the matrices. */
    const Responses &responses() const;

    /** The residual of a point or a span for a force and a moment, 6 a frame. */
    template <typename Number>
    using Local = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    template <typename Number>
    void local_residual(const AtPoint &load, const Vec6<Number> &wrench, const Number *q, Local<Number> &r) const;
    template <typename Number>
    void local_residual(const AlongSpan &span, const Vec6<Number> &wrench, const Number *q, Local<Number> &r) const;

    /** What comes from the change of force and moment, of one point or span. */
    template <typename Part>
    void add_responses(const Part &part, const Point<double> &point, bool by_velocity, SparseMatrix &A) const;

    void add_tangent(const AlongSpan &span, const Vector3 &f, const Vector3 &m, const double *q, SparseMatrix &K) const;
  };



  /** A force and a moment at a point of a body. */
  class ConcentratedLoad : public WrenchLoad
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

  private:
    std::string at;
  };



  /**
   * A force p(s) f and a moment p(s) m per length along a beam or an edge of a shell, p its variation. The virtual work
   * is
   *
   *     ∫ p (f · δx + m · δθ) ds,   x = Σ N_a x_a,  δθ = Σ N_a D_a θ_a,   of a follower with d f, d m for d = Σ N_a
   * D_a,
   *
   * with the shape functions N_a of an element and the exact arc length, integrated by Gauss's rule on each piece
   * between the jumps and corners of p: force and moment that result are those of p on the interpolated line, wherever
   * elements end.
   */
  class LineLoad : public WrenchLoad
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

  private:
    std::string body, edge;
    Expression  variation{1.};

    /** Whether it acts anywhere on the span. */
    bool add_span(const Span &span);
  };



  /**
   * A steady rotation, the load case of statics and the state about which modes are sought: of the whole model about an
   * axis fixed in space, or of a joint, with everything that is carried along. A joint is held at its azimuth in
   * statics; in modes and dynamics it is free to turn. If the joint's angle is prescribed, that keeps it instead.
   */
  class SteadyRotation : public Item, public Evaluated<SteadyRotation, Constraint>
  {
  public:
    std::string
    noun() const override
    {
      return "steady rotation";
    }

    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;

    bool
    acts_on_whole_model() const override
    {
      return joint.empty();
    }

    /** The angle is held in statics, where nothing moves against it: there are no rates. */
    void
    rates(const Point<double> &, double *) const override
    {}
    void
    second_rates(const Point<double> &, double *) const override
    {}

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

  private:
    Model::Rotation rotation;
    std::string     joint;
    double          azimuth    = 0;
    bool            holding    = false; ///< at a joint, and nothing else prescribes its motion
    Model          *model      = nullptr;
    unsigned int    multiplier = 0;
    Block           block;
  };

  // instantiated where the templates of the classes are defined
  extern template class Evaluated<Gravity, Force>;
  extern template class Evaluated<WrenchLoad, Force>;
  extern template class Evaluated<SteadyRotation, Constraint>;
} // namespace samara

#endif

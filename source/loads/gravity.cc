#include <samara/loads/loads.h>
#include <samara/model/virtual_mass.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    template <typename Point>
    Vector3
    value(const VectorOfTime &f, const Point &point)
    {
      return point.factor * Vector3(f[0](point.time), f[1](point.time), f[2](point.time));
    }
  } // namespace



  void
  Gravity::add_parameters(Parameters &prm)
  {
    prm.add("Acceleration", acceleration, "Components, functions of time t [m/s^2].");
  }



  void
  Gravity::initialize(Model &m)
  {
    model = &m;
  }



  void
  Gravity::connect(Layout &layout)
  {
    blocks.resize(layout.n_nodes);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      layout.couple(blocks[node], {Frame{node}});
    without_weight = virtual_mass(layout.model);
    layout.add(*this, *this);
  }



  Eigen::Matrix<double, 6, 3>
  Gravity::weighed(const unsigned int node) const
  {
    Eigen::Matrix<double, 6, 3> M = model->nodes[node].inertia.leftCols<3>();
    if (!without_weight.empty())
      M -= without_weight[node].leftCols<3>();
    return M;
  }



  template <typename Number>
  void
  Gravity::residual_at(const Point<Number> &point, Number *r) const
  {
    // Block::add() changes it; memory is not asked for again
    static thread_local Eigen::Matrix<Number, Eigen::Dynamic, 1> local(6);
    const Vector3                                                a = value(acceleration, point);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        const Mat3<Number>                D      = Frame{node}.triad(point.q);
        const Eigen::Matrix<Number, 3, 1> a_node = D.transpose() * a;
        local.noalias()                          = -weighed(node) * a_node;
        blocks[node].add(local, r);
      }
  }



  void
  Gravity::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    static thread_local Eigen::MatrixXd local(6, 6);
    const Vector3                       a = value(acceleration, point);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        const Matrix3 D = Frame{node}.triad(point.q);
        local.setZero();
        local.rightCols<3>() = -weighed(node) * skew((D.transpose() * a).eval());
        blocks[node].add(local, K);
      }
  }



  bool
  Gravity::has_potential() const
  {
    return std::all_of(acceleration.begin(), acceleration.end(), [](const auto &a) { return a.is_constant(); });
  }



  double
  Gravity::potential_energy(const Point<double> &point) const
  {
    double        energy = 0;
    const Vector3 a      = value(acceleration, point);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        // m (x + D c), with m c~ in the inertia
        const Eigen::Matrix<double, 6, 3> M = weighed(node);
        const Frame                       frame{node};
        const Vector3                     moment =
          M(0, 0) * frame.position(point.q) + frame.triad(point.q) * axial(M.bottomRows<3>());
        energy -= a.dot(moment);
      }
    return energy;
  }



  double
  Gravity::next_corner(const double from, const double to) const
  {
    return first_corner(acceleration, from, to);
  }



  template class Evaluated<Gravity, Force>;
} // namespace samara

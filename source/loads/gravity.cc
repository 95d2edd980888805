#include <samara/loads/loads.h>
#include <samara/model/virtual_mass.h>

#include <algorithm>

namespace samara
{
  void
  Gravity::add_parameters(Parameters &prm)
  {
    prm.add("Acceleration", acceleration, "Components, expressions of time t and signals [m/s^2].");
  }



  void
  Gravity::initialize(Model &m)
  {
    model = &m;
  }



  void
  Gravity::find_signals(Model &m)
  {
    if (std::none_of(acceleration.begin(), acceleration.end(), [](const Law &a) { return a.depends_on_state(); }))
      return;
    try
      {
        // one a node, as their rows differ; nodes that others are welded to stay without
        responses.resize(m.nodes.size());
        for (auto &of_node : responses)
          for (unsigned int i = 0; i < 3; ++i)
            if (acceleration[i].depends_on_state())
              of_node[i] = std::make_unique<Response>(acceleration[i], m);
      }
    catch (const std::invalid_argument &problem)
      {
        m.complaints.add(parameters.where("Acceleration"), problem.what());
      }
  }



  void
  Gravity::connect(Layout &layout)
  {
    blocks.resize(layout.n_nodes);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        layout.couple(blocks[node], {Frame{node}});
        for (unsigned int i = 0; i < 3 && !responses.empty(); ++i)
          if (responses[node][i])
            responses[node][i]->connect(layout, {{Frame{node}}, {}, {}, {}});
      }
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
  Vec3<Number>
  Gravity::acceleration_at(const Point<Number> &point) const
  {
    const bool   is_of_state = responses.size() > 1 && blocks.size() > 1;
    Vec3<Number> result;
    for (unsigned int i = 0; i < 3; ++i)
      result(i) = point.factor * (is_of_state && responses[1][i]     ? (*responses[1][i])(point) :
                                  acceleration[i].depends_on_state() ? Number(0) :
                                                                       Number(acceleration[i].of_time()(point.time)));
    return result;
  }



  template <typename Number>
  void
  Gravity::residual_at(const Point<Number> &point, Number *r) const
  {
    // Block::add() changes it; memory is not asked for again
    static thread_local Eigen::Matrix<Number, Eigen::Dynamic, 1> local(6);
    const Vec3<Number>                                           a = acceleration_at(point);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        const Mat3<Number> D      = Frame{node}.triad(point.q);
        const Vec3<Number> a_node = D.transpose() * a;
        local.noalias()           = -weighed(node) * a_node;
        blocks[node].add(local, r);
      }
  }



  void
  Gravity::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    static thread_local Eigen::MatrixXd local(6, 6);
    const Vector3                       a = acceleration_at(point);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        const Matrix3 D = Frame{node}.triad(point.q);
        local.setZero();
        local.rightCols<3>() = -weighed(node) * skew((D.transpose() * a).eval());
        blocks[node].add(local, K);
      }
    add_responses(point, false, K);
  }



  void
  Gravity::damping(const Point<double> &point, SparseMatrix &C) const
  {
    add_responses(point, true, C);
  }



  void
  Gravity::add_responses(const Point<double> &point, const bool by_velocity, SparseMatrix &A) const
  {
    for (unsigned int node = 1; node < blocks.size() && !responses.empty(); ++node)
      for (unsigned int i = 0; i < 3; ++i)
        if (responses[node][i])
          {
            const Vector3 along        = Frame{node}.triad(point.q).row(i).transpose();
            const Vector6 coefficients = -point.factor * weighed(node) * along;
            if (by_velocity)
              responses[node][i]->add_damping(point, coefficients, A);
            else
              responses[node][i]->add_tangent(point, coefficients, A);
          }
  }



  void
  Gravity::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    if (responses.size() > 1)
      for (const auto &response : responses[1])
        if (response)
          response->pieces(point, result);
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
    const Vector3 a      = acceleration_at(point);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        // m (x + D c), with m c~ in the inertia
        const Eigen::Matrix<double, 6, 3> M = weighed(node);
        const Frame                       frame{node};
        const Vector3 moment = M(0, 0) * frame.position(point.q) + frame.triad(point.q) * axial(M.bottomRows<3>());
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

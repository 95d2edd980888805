#include <samara/aero/external_inflow.h>

#include <deal.II/base/exceptions.h>

#include <map>

namespace samara
{
  void
  ExternalInflow::add_parameters(Parameters &prm)
  {
    Inflow::add_parameters(prm);
    prm.add("Time constant",
            time_constant,
            "How slowly the states of the wake follow the loads [s].",
            dealii::Patterns::Double(1e-300));
  }



  void
  ExternalInflow::initialize(Model &model)
  {
    Inflow::initialize(model);
    if (varies)
      model.complaints.add(parameters.where("Radius"),
                           "the wake of <" + name +
                             "> is that of a disk whose radius stays: functions of time are for the other inflows");
    if (air == nullptr)
      return;
    try
      {
        for (const auto &[state, unit] : names_of_states(model))
          {
            // flows are speeds, circulations are speeds times lengths
            const double scale = 0.1 * air->small_speed() * (unit == "m^2/s" ? radius : 1.);
            states.push_back(model.add_state(name + ", " + state, unit, 0., scale));
            units.push_back(unit);
          }
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(), "<" + name + ">: " + problem.what());
      }
    load_weights.assign(states.size(), 1 / time_constant);
    corrections.needs_flow = true;
    corrections.ground     = air->ground;
  }



  void
  ExternalInflow::connect(Layout &layout)
  {
    Inflow::connect(layout);
    layout.couple(block, {}, {}, {}, states);
    layout.add(*this, *this);
  }



  std::vector<CountedStates>
  ExternalInflow::counted_states() const
  {
    std::map<std::string, CountedStates> of_unit;
    for (unsigned int k = 0; k < states.size(); ++k)
      {
        of_unit[units[k]].states.push_back(states[k]);
        of_unit[units[k]].metric.push_back(1.);
      }
    std::vector<CountedStates> groups;
    for (auto &[unit, group] : of_unit)
      groups.push_back(std::move(group));
    return groups;
  }



  ExternalInflow::Derivatives
  ExternalInflow::derivatives(const Vector3 &x, const Flow<double> &flow, const std::vector<double> &z) const
  {
    // complex steps: exact, since nothing is subtracted
    constexpr double   step = 1e-30;
    const unsigned int n    = states.size();
    AssertDimension(z.size(), n);
    std::vector<Complex> z_c(z.begin(), z.end()), b(n);
    std::vector<double>  A(3 * n);
    Derivatives          d;
    d.velocity.setZero();
    d.drives.setZero(n, 8);
    for (unsigned int i = 0; i < 8; ++i)
      {
        if (i >= 3 && !sees(i - 3))
          continue;
        Vec3<Complex> at = x.cast<Complex>();
        Flow<Complex> in = flow.cast<Complex>();
        (i < 3 ? at(i) : in(i - 3)) += Complex(0, step);
        d.velocity.col(i) = velocity(at, in, z_c.data()).imag() / step;
        drives(at, in, b.data());
        for (unsigned int k = 0; k < n; ++k)
          d.drives(k, i) = b[k].imag() / step;
      }
    velocities(x, flow, A.data());
    d.by_states = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>>(A.data(), 3, n);
    return d;
  }



  // T ż = b − z: stations of surfaces add their drives b, with the weights 1/T
  template <typename Number>
  void
  ExternalInflow::residual_at(const Point<Number> &point, Number *r) const
  {
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local(block.size());
    for (unsigned int k = 0; k < states.size(); ++k)
      local(k) = point.states[states[k]] / time_constant;
    block.add(local, r);
  }



  void
  ExternalInflow::tangent(const Point<double> &, SparseMatrix &K) const
  {
    Eigen::MatrixXd local = Eigen::MatrixXd::Identity(block.size(), block.size()) / time_constant;
    block.add(local, K);
  }



  template class Evaluated<ExternalInflow, StateEquation>;
} // namespace samara

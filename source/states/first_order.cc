#include <samara/states/first_order.h>

namespace samara
{
  void
  FirstOrder::add_parameters(Parameters &prm)
  {
    prm.add("Rate",
            rate,
            "Rate of the state, in its unit a second: an expression of time t, of states and of what objects tell: "
            "(hinge.rotation - filter)/(0.1 s).");
    prm.add("Initial", initial, "Value at the start, in its unit.");
    prm.add("Unit", unit, "SI unit of the state, as a quantity of expressions: m, N, rad/s; empty: a number.");
    prm.add("Scale",
            scale,
            "Size of the state, in its unit, below which its changes do not count for convergence.",
            dealii::Patterns::Double(1e-300));
    prm.add(
      "Weight",
      weight,
      "How much relative errors of the state count for adaptive steps, beside those of positions over the length: "
      "1 as much, 0 not at all [1].",
      dealii::Patterns::Double(0));
    const auto own_unit = [this](const Quantities &quantities) {
      const std::string given = quantities.signals.unit_of_state(name);
      return given.empty() ? "1" : "(" + given + ")";
    };
    prm.take_unit("Rate", [=](const Quantities &quantities) { return own_unit(quantities) + "/s"; });
    prm.take_unit("Initial", own_unit);
    prm.take_unit("Scale", own_unit);
  }



  void
  FirstOrder::initialize(Model &model)
  {
    if (!unit.empty() && !Quantities::is_si_unit(unit))
      model.complaints.add(parameters.where("Unit"), "<" + unit + "> is not an SI unit: write m, rad/s, N*m, ...");
    number = model.add_state(name, unit, initial, scale);
  }



  void
  FirstOrder::find_signals(Model &model)
  {
    if (!rate.depends_on_state())
      return;
    try
      {
        response = std::make_unique<Response>(rate, model);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("Rate"), problem.what());
      }
  }



  void
  FirstOrder::connect(Layout &layout)
  {
    row = layout.of_state(number);
    layout.couple(block, {}, {}, {}, {number});
    if (response)
      response->connect(layout, {{}, {}, {number}, {}});
    layout.add(*this, *this);
  }



  template <typename Number>
  void
  FirstOrder::residual_at(const Point<Number> &point, Number *r) const
  {
    r[row] -= response ? (*response)(point) : Number(rate.of_time()(point.time));
  }



  void
  FirstOrder::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    if (response)
      response->add_tangent(point, Eigen::VectorXd::Constant(1, -1.), K);
  }



  void
  FirstOrder::damping(const Point<double> &point, SparseMatrix &C) const
  {
    if (response)
      response->add_damping(point, Eigen::VectorXd::Constant(1, -1.), C);
  }



  double
  FirstOrder::next_corner(const double from, const double to) const
  {
    return rate.next_corner(from, to);
  }



  void
  FirstOrder::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    if (response)
      response->pieces(point, result);
  }



  std::optional<Probe>
  FirstOrder::probe(const std::string &path) const
  {
    if (!path.empty())
      return {};
    return Probe{"", unit.empty() ? "1" : unit, [this](const State &state) { return state.states[number]; }};
  }



  template class Evaluated<FirstOrder, StateEquation>;
} // namespace samara

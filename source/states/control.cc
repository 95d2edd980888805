#include <samara/model/layout.h>
#include <samara/model/matrix.h>
#include <samara/states/control.h>

namespace samara
{
  void
  Control::add_parameters(Parameters &prm)
  {
    prm.add("Value", value, "Value of the control, in its unit; trim starts from it.");
    prm.add("Unit", unit, "SI unit of the control, as a quantity of expressions: rad, m, N; empty: a number.");
    prm.add("Scale",
            scale,
            "A small change of the control, in its unit: what trim varies it by, and below which changes do not count "
            "for convergence.",
            dealii::Patterns::Double(1e-300));
    const auto own_unit = [this](const Quantities &quantities) {
      const std::string given = quantities.signals.unit_of_state(name);
      return given.empty() ? "1" : "(" + given + ")";
    };
    prm.take_unit("Value", own_unit);
    prm.take_unit("Scale", own_unit);
  }



  void
  Control::initialize(Model &model)
  {
    if (!unit.empty() && !Quantities::is_si_unit(unit))
      model.complaints.add(parameters.where("Unit"), "<" + unit + "> is not an SI unit: write m, rad, N, ...");
    number = model.add_state(name, unit, value, scale);
  }



  void
  Control::connect(Layout &layout)
  {
    row = layout.of_state(number);
    layout.couple(block, {}, {}, {}, {number});
    layout.add(*this, *this);
  }



  template <typename Number>
  void
  Control::residual_at(const Point<Number> &point, Number *r) const
  {
    if (point.held) // statics
      r[row] += point.states[number] - value;
  }



  void
  Control::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
    if (point.held)
      block.add(one, K);
  }



  void
  Control::damping(const Point<double> &, SparseMatrix &) const
  {}



  std::optional<Probe>
  Control::probe(const std::string &path) const
  {
    if (!path.empty())
      return {};
    return Probe{"", unit.empty() ? "1" : unit, [this](const State &state) { return state.states[number]; }};
  }



  template class Evaluated<Control, StateEquation>;
} // namespace samara

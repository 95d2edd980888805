#include <samara/states/controller.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace samara
{
  void
  Controller::add_unit(Parameters &prm)
  {
    prm.add("Unit", unit, "SI unit of the output, as a quantity of expressions: N, N*m, rad; empty: a number.");
  }



  void
  Controller::check_unit(Model &model, const std::string &entry, const std::string &given) const
  {
    if (!given.empty() && !Quantities::is_si_unit(given))
      model.complaints.add(parameters.where(entry), "<" + given + "> is not an SI unit: write m, rad/s, N*m, ...");
  }



  void
  Controller::add_state(Model             &model,
                        const std::string &what,
                        const std::string &unit,
                        const double       initial,
                        const double       scale)
  {
    numbers.push_back(model.add_state(name + " " + what, unit, initial, scale));
  }



  void
  Controller::find_signals(Model &model)
  {
    bool are_known = true;
    for (const Input &input : inputs())
      try
        {
          signal_of_law(*input.law, model);
        }
      catch (const std::invalid_argument &problem)
        {
          model.complaints.add(parameters.where(input.entry), problem.what());
          are_known = false;
        }
    if (!are_known)
      return;
    rates.clear();
    outputs.clear();
    try
      {
        for (unsigned int i = 0; i < numbers.size(); ++i)
          rates.emplace_back(rate(model, i));
        for (unsigned int i = 0; i < n_outputs(); ++i)
          outputs.push_back(signal(model, std::to_string(i + 1)));
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(), problem.what());
      }
  }



  void
  Controller::connect(Layout &layout)
  {
    Assert(rates.size() == numbers.size(), dealii::ExcMessage("find_signals() comes before connect()."));
    rows.clear();
    for (unsigned int i = 0; i < numbers.size(); ++i)
      {
        rows.push_back(layout.of_state(numbers[i]));
        rates[i].connect(layout, {{}, {}, {numbers[i]}, {}});
      }
    layout.couple(block, {}, {}, {}, numbers);
    layout.when_numbered([this, &layout]() {
      for (const auto &output : outputs)
        output->resolve(layout.model);
    });
    layout.add(*this, *this);
  }



  // E ż = g with E = 1, which the integrators and C_zz add: the residual has −g
  template <typename Number>
  void
  Controller::residual_at(const Point<Number> &point, Number *r) const
  {
    for (unsigned int i = 0; i < rows.size(); ++i)
      r[rows[i]] -= rates[i](point);
  }



  void
  Controller::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    for (const Response &rate : rates)
      rate.add_tangent(point, Eigen::VectorXd::Constant(1, -1.), K);
  }



  void
  Controller::damping(const Point<double> &point, SparseMatrix &C) const
  {
    for (const Response &rate : rates)
      rate.add_damping(point, Eigen::VectorXd::Constant(1, -1.), C);
  }



  double
  Controller::next_corner(const double from, const double to) const
  {
    double corner = std::numeric_limits<double>::infinity();
    for (const Response &rate : rates)
      corner = std::min(corner, rate.next_corner(from, to));
    for (const auto &output : outputs)
      corner = std::min(corner, output->next_corner(from, to));
    return corner;
  }



  void
  Controller::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    for (const Response &rate : rates)
      rate.pieces(point, result);
    for (const auto &output : outputs)
      output->pieces(point, result);
  }



  std::optional<unsigned int>
  Controller::output_number(const std::string &path) const
  {
    for (unsigned int i = 0; i < n_outputs(); ++i)
      if (path == std::to_string(i + 1) || (path.empty() && n_outputs() == 1))
        return i;
    return {};
  }



  std::shared_ptr<Signal>
  Controller::signal(Model &model, const std::string &path)
  {
    const auto i = output_number(path);
    if (!i)
      return nullptr;
    if (is_asked)
      throw std::invalid_argument("the output of <" + name +
                                  "> depends on itself at the same moment, through what it " +
                                  "is made of; put a state of first order, or a delay, in between.");
    // an output that is asked for while it is made needs itself: an algebraic loop
    struct Asked
    {
      bool &flag;
      explicit Asked(bool &flag)
        : flag(flag)
      {
        flag = true;
      }
      ~Asked()
      {
        flag = false;
      }
    };
    const Asked asked(is_asked);
    return output(model, *i);
  }



  std::optional<Probe>
  Controller::probe(const std::string &path) const
  {
    const auto i = output_number(path);
    if (!i || *i >= outputs.size())
      return {};
    return Probe{"", unit.empty() ? "1" : unit, [this, i = *i](const State &state) {
                   return outputs[i]->value(state.point());
                 }};
  }



  template class Evaluated<Controller, StateEquation>;
} // namespace samara

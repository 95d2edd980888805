#include <samara/states/controller.h>

#include <deal.II/base/exceptions.h>

#include <cmath>

namespace samara
{
  void
  LinearController::add_states(Model &model, const Eigen::VectorXd &initial, const double scale)
  {
    AssertDimension(initial.size(), A.rows());
    for (unsigned int i = 0; i < A.rows(); ++i)
      add_state(model, "state " + std::to_string(i + 1), "", initial(i), scale);
  }



  SignalPointer
  LinearController::combination(Model &model, const Eigen::RowVectorXd &a, const Eigen::RowVectorXd &b) const
  {
    AssertDimension(a.size(), A.rows());
    AssertDimension(b.size(), laws.size());
    std::vector<Summand> summands;
    for (unsigned int i = 0; i < a.size(); ++i)
      if (a(i) != 0)
        summands.push_back({a(i), state(i)});
    for (unsigned int i = 0; i < b.size(); ++i)
      if (b(i) != 0)
        summands.push_back({b(i), signal_of_law(laws[i], model)});
    return sum_of_signals(summands);
  }



  SignalPointer
  LinearController::rate(Model &model, const unsigned int i) const
  {
    return combination(model, A.row(i), B.row(i));
  }



  SignalPointer
  LinearController::output(Model &model, const unsigned int i) const
  {
    return combination(model, C.row(i), D.row(i));
  }



  void
  StateSpace::add_parameters(Parameters &prm)
  {
    prm.add("Inputs",
            laws,
            "What goes in: expressions of time t and signals, u_1, u_2, in SI units, of any dimension.");
    prm.add("A", given_A, "Rates by states, row by row: a, b; c, d [1].");
    prm.add("B", given_B, "Rates by inputs, a row for each state [1].");
    prm.add("C", given_C, "Outputs by states, a row for each output [1].");
    prm.add("D", given_D, "Outputs by inputs; not given: zero [1].");
    add_unit(prm);
    prm.add("Initial", initial, "States at the start; not given: zero [1].");
    prm.add("Scale",
            scale,
            "Size of the states below which their changes do not count for convergence [1].",
            dealii::Patterns::Double(1e-300));
    prm.take_unit("Inputs", [](const Quantities &) { return std::string(); });
  }



  void
  StateSpace::initialize(Model &model)
  {
    check_unit(model, "Unit", unit);
    bool is_right = true;
    for (const std::string entry : {"Inputs", "A", "B", "C"})
      is_right = parameters.require(entry, model.complaints) && is_right;
    if (!is_right)
      return;
    const unsigned int n = given_A.size(), m = laws.size(), p = given_C.size();
    const auto         take = [&](const std::string                      &entry,
                          const std::vector<std::vector<double>> &rows,
                          const unsigned int                      n_rows,
                          const unsigned int                      n_columns,
                          Eigen::MatrixXd                        &matrix) {
      matrix = Eigen::MatrixXd::Zero(n_rows, n_columns);
      if (rows.empty() && entry == "D")
        return;
      bool fits = rows.size() == n_rows;
      for (const auto &row : rows)
        fits = fits && row.size() == n_columns;
      if (!fits)
        {
          model.complaints.add(parameters.where(entry),
                               "<" + entry + "> of <" + name + "> must have " + std::to_string(n_rows) + " rows of " +
                                 std::to_string(n_columns) + " numbers, for " + std::to_string(n) + " states, " +
                                 std::to_string(m) + " inputs and " + std::to_string(p) + " outputs");
          is_right = false;
          return;
        }
      for (unsigned int i = 0; i < n_rows; ++i)
        for (unsigned int j = 0; j < n_columns; ++j)
          matrix(i, j) = rows[i][j];
    };
    take("A", given_A, n, n, A);
    take("B", given_B, n, m, B);
    take("C", given_C, p, n, C);
    take("D", given_D, p, m, D);
    if (initial.empty())
      initial.assign(n, 0.);
    if (initial.size() != n)
      model.complaints.add(parameters.where("Initial"),
                           "<Initial> must have a number for each of the " + std::to_string(n) + " states");
    else if (is_right)
      add_states(model, Eigen::Map<const Eigen::VectorXd>(initial.data(), n), scale);
  }



  std::vector<Controller::Input>
  StateSpace::inputs() const
  {
    std::vector<Input> all;
    for (const Law &law : laws)
      all.push_back({"Inputs", &law});
    return all;
  }



  void
  TransferFunction::add_parameters(Parameters &prm)
  {
    prm.add("Input", input, "What goes in: an expression of time t and signals, in SI units, of any dimension.");
    prm.add("Numerator", numerator, "Coefficients, that of the highest power of s first, in SI units [1].");
    prm.add("Denominator", denominator, "The same; its degree is at least that of the numerator [1].");
    add_unit(prm);
    prm.add("Scale",
            scale,
            "Size of the input below which its changes do not count for convergence, in SI units [1].",
            dealii::Patterns::Double(1e-300));
    prm.take_unit("Input", [](const Quantities &) { return std::string(); });
  }



  void
  TransferFunction::initialize(Model &model)
  {
    const auto complain = [&](const std::string &entry, const std::string &text) {
      model.complaints.add(parameters.where(entry), text);
    };
    check_unit(model, "Unit", unit);
    bool is_right = true;
    for (const std::string entry : {"Input", "Numerator", "Denominator"})
      is_right = parameters.require(entry, model.complaints) && is_right;
    if (!is_right)
      return;
    if (denominator[0] == 0)
      return complain("Denominator", "the first coefficient is that of the highest power of s and must not be zero");
    if (denominator.size() < 2)
      return complain("Denominator", "<" + name + "> has no state: the factor of an expression does the same");
    if (numerator.size() > denominator.size())
      return complain("Numerator",
                      "the degree of the numerator must not be above that of the denominator: what is in front of a "
                      "derivative cannot be known");
    const unsigned int n = denominator.size() - 1;
    numerator.insert(numerator.begin(), n + 1 - numerator.size(), 0.);

    // the lowest coefficient that is there sets the unit of time: σ = s/ω
    double       omega = 1;
    unsigned int last  = n;
    while (last > 0 && denominator[last] == 0)
      --last;
    if (last > 0)
      omega = std::pow(std::abs(denominator[last] / denominator[0]), 1. / last);
    Eigen::VectorXd a(n + 1), b(n + 1); // by powers of σ, of σ^n first
    for (unsigned int i = 0; i <= n; ++i)
      {
        const double size = std::pow(omega, -double(i));
        a(i)              = denominator[i] / denominator[0] * size;
        b(i)              = numerator[i] / denominator[0] * size;
      }
    if (!a.allFinite() || !b.allFinite())
      return complain("Denominator", "these coefficients are too different to compute with");
    // controllable form in σ: x_i' = ω x_{i+1}, the last x' = ω (u − Σ a x), and y = Σ (b − a b_n) x + b_n u, b_n =
    // b(0)
    A = Eigen::MatrixXd::Zero(n, n);
    B = Eigen::MatrixXd::Zero(n, 1);
    C = Eigen::MatrixXd::Zero(1, n);
    D = Eigen::MatrixXd::Constant(1, 1, b(0));
    for (unsigned int i = 0; i < n; ++i)
      {
        if (i + 1 < n)
          A(i, i + 1) = omega;
        A(n - 1, i) = -omega * a(n - i);
        C(0, i)     = b(n - i) - a(n - i) * b(0);
      }
    B(n - 1, 0) = omega;
    laws        = {input};
    add_states(model, Eigen::VectorXd::Zero(n), scale);
  }



  std::vector<Controller::Input>
  TransferFunction::inputs() const
  {
    return {{"Input", &input}};
  }



  void
  Delay::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    prm.add("Input", input, "What is delayed: an expression of time t and signals, in the unit of the output.");
    prm.add("Time", time, "By how much [s].", Double(0));
    prm.add("Order", order, "Degree of the Padé approximant: how many states.", dealii::Patterns::Integer(1, 30));
    add_unit(prm);
    prm.add("Initial", initial, "The input before the start, in its unit.");
    prm.add("Scale",
            scale,
            "Size of the input, in its unit, below which its changes do not count for convergence.",
            Double(1e-300));
    const auto own = [this](const Quantities &q) {
      const std::string given = q.signals.unit_of_state(name);
      return given.empty() ? "1" : "(" + given + ")";
    };
    for (const std::string entry : {"Input", "Initial", "Scale"})
      prm.take_unit(entry, own);
  }



  void
  Delay::initialize(Model &model)
  {
    check_unit(model, "Unit", unit);
    const bool has_input = parameters.require("Input", model.complaints),
               has_time  = parameters.require("Time", model.complaints);
    if (has_time && !(time > 0))
      model.complaints.add(parameters.where("Time"), "the <Time> of a delay must be above zero");
    if (!has_input || !(time > 0))
      return;
    // Padé's approximant of degree n − 1 over n. States are the coefficients of the last T seconds in shifted Legendre
    // polynomials (Voelker & Eliasmith, Neural Computation 30 (2018) 569); these are 1 at the far end, so that the
    // delayed value is the sum of the states
    const unsigned int n = order;
    A                    = Eigen::MatrixXd(n, n);
    B                    = Eigen::MatrixXd(n, 1);
    C                    = Eigen::MatrixXd::Ones(1, n);
    D                    = Eigen::MatrixXd::Zero(1, 1);
    for (unsigned int i = 0; i < n; ++i)
      {
        const double factor = (2. * i + 1) / time;
        B(i, 0)             = factor * (i % 2 == 0 ? 1. : -1.);
        for (unsigned int j = 0; j < n; ++j)
          A(i, j) = factor * (i < j || (i - j) % 2 == 0 ? -1. : 1.);
      }
    laws = {input};
    add_states(model, initial * Eigen::VectorXd::Unit(n, 0), scale);
  }



  std::vector<Controller::Input>
  Delay::inputs() const
  {
    return {{"Input", &input}};
  }
} // namespace samara

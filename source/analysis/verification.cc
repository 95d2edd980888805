#include <samara/analysis/complex_step.h>
#include <samara/analysis/verification.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/strain_products.h>
#include <samara/solvers/newton.h>

#include <algorithm>
#include <random>

namespace samara
{
  namespace
  {
    constexpr unsigned int most_unknowns = 3000;

    /** Of the reference, so far that strains are large and laws are not linear any more. */
    State
    random_state(const System &system)
    {
      std::mt19937                           random(11);
      std::uniform_real_distribution<double> number(-0.3, 0.3);
      State                                  state = system.reference();
      std::vector<double>                    z(system.size());
      std::generate(z.begin(), z.end(), [&]() { return number(random); });
      const double length = model_length(system.model);
      for (int i = 0; i < system.layout.of_state(0); ++i)
        if (system.layout.is_length(i))
          z[i] *= length;
      system.update(state, z);
      return state;
    }

    /** All nodes but the ground turned by 2 rad about a skew axis through the origin, and moved. */
    State
    moved_rigidly(const System &system, State state)
    {
      const Matrix3 R = rotation_of_vector(2. * Vector3(1, 2, -2).normalized());
      const Vector3 d = model_length(system.model) * Vector3(3, -2, 5);
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        {
          Eigen::Map<Vector3> x(&state.q[12 * node]);
          Eigen::Map<Matrix3> D(&state.q[12 * node + 3]);
          x = (R * x + d).eval();
          D = (R * D).eval();
        }
      return state;
    }

    /** Third difference of the strains along a random line through the places and triads of the nodes. */
    std::vector<double>
    third_differences(const System &system, const State &state)
    {
      std::mt19937                           random(5);
      std::uniform_real_distribution<double> number(-0.1, 0.1);
      const double                           length = model_length(system.model);
      std::vector<double>                    direction(state.q.size(), 0.);
      for (unsigned int i = 12; i < direction.size(); ++i)
        direction[i] = number(random) * (i % 12 < 3 ? length : 1.);
      std::vector<double> sum(system.layout.n_strains, 0.), e;
      const double        weights[] = {-1, 3, -3, 1};
      for (unsigned int k = 0; k < 4; ++k)
        {
          State at = state;
          for (unsigned int i = 0; i < at.q.size(); ++i)
            at.q[i] += k * direction[i];
          system.strains(at, e);
          for (unsigned int i = 0; i < sum.size(); ++i)
            sum[i] += weights[k] * e[i];
        }
      // products of quadratic strains are integrated as such
      for (const auto &product : strain_products(system.model))
        sum[product.result] = 0;
      return sum;
    }

    /** Rates of all strains for unit twists of the nodes, a column for each unknown of a node. */
    Eigen::MatrixXd
    strain_matrix(const System &system, const State &state)
    {
      const unsigned int  n = system.layout.of_coordinate(0);
      Eigen::MatrixXd     B(system.layout.n_strains, n);
      std::vector<double> y(6 + n, 0.), rates(system.layout.n_strains), no_rates(system.layout.n_coordinates, 0.);
      Point<double>       point = state.point();
      point.y                   = y.data();
      point.rates               = no_rates.data();
      for (unsigned int j = 0; j < n; ++j)
        {
          y[6 + j] = 1;
          system.strain_rates(point, rates.data());
          y[6 + j] = 0;
          B.col(j) = Eigen::Map<const Eigen::VectorXd>(rates.data(), rates.size());
        }
      return B;
    }

    /** Unknowns that appear in some rows of B, less their rank: twists that leave these strains as they are. */
    unsigned int
    n_free_motions(const Eigen::Ref<const Eigen::MatrixXd> &B)
    {
      std::vector<int> used;
      for (int j = 0; j < B.cols(); j += 6)
        if (!B.middleCols(j, 6).isZero(0.))
          for (int k = 0; k < 6; ++k)
            used.push_back(j + k);
      if (used.empty())
        return 0;
      Eigen::MatrixXd here(B.rows(), used.size());
      for (unsigned int j = 0; j < used.size(); ++j)
        here.col(j) = B.col(used[j]);
      // lengths and angles differ in size: a column of its own size each, and so the rows
      for (int j = 0; j < here.cols(); ++j)
        if (const double size = here.col(j).norm(); size > 0)
          here.col(j) /= size;
      for (int i = 0; i < here.rows(); ++i)
        if (const double size = here.row(i).norm(); size > 0)
          here.row(i) /= size;
      // rows and columns have length one: a pivot below is a motion without strain
      return used.size() - PivotedQr(here, 1e-9).rank();
    }

    double
    largest(const std::vector<double> &values, const unsigned int first, const unsigned int n)
    {
      double result = 0;
      for (unsigned int i = first; i < first + n; ++i)
        result = std::max(result, std::abs(values[i]));
      return result;
    }
  } // namespace



  void
  VerificationAnalysis::add_parameters(Parameters &prm)
  {
    prm.add("Tolerance",
            tolerance,
            "Relative error of derivatives, and change of strains in rigid motions, beyond which an element is wrong.",
            dealii::Patterns::Double(0));
    prm.add("Studies",
            studies,
            "Parameter studies that are run behind it, relative to the model's file: of orders of convergence, of the "
            "thin limit, of energy in motion; report.md in the folder of the results has the tables of all.");
  }



  void
  VerificationAnalysis::run(Context &context)
  {
    if (context.system.size() > most_unknowns)
      throw InputError("<verification> fills matrices of " + std::to_string(context.system.size()) +
                       " unknowns; it takes up to " + std::to_string(most_unknowns) + ". Take fewer elements.");
    check_derivatives(context.system);
    look_at_items(context);
    write(context);
    if (const std::string wrong = complaint(); !wrong.empty())
      throw NotConverged("verification: " + wrong);
  }



  void
  VerificationAnalysis::check_derivatives(const System &system)
  {
    const ComplexStep check(system);
    const auto        place = [&]() {
      return "row <" + system.layout.name_of(check.worst_row) + ">, column <" +
             system.layout.name_of(check.worst_column) + ">";
    };
    error_of_tangent = check.error_of_tangent();
    worst_place      = place();
    error_of_damping = check.error_of_damping();
    if (error_of_damping > error_of_tangent)
      worst_place = place();
    error_of_rates = check.error_of_strain_rates();
  }



  void
  VerificationAnalysis::look_at_items(const Context &context)
  {
    const System             &system = context.system;
    const State               state  = random_state(system);
    std::vector<double>       e, e_moved;
    const std::vector<double> third = third_differences(system, state);
    system.strains(state, e);
    system.strains(moved_rigidly(system, state), e_moved);
    for (unsigned int i = 0; i < e.size(); ++i)
      e_moved[i] -= e[i];
    const Eigen::MatrixXd B = strain_matrix(system, system.reference());
    rows.clear();
    // the strains of an item follow each other
    for (unsigned int first = 0, n = 0; first < e.size(); first += n)
      {
        const Item &item = system.layout.item_of_strain(first);
        for (n = 1; first + n < e.size() && &system.layout.item_of_strain(first + n) == &item;)
          ++n;
        const double size = largest(e, first, n);
        rows.push_back({item.name,
                        item.kind,
                        n,
                        n_free_motions(B.middleRows(first, n)),
                        size > 0 ? largest(e_moved, first, n) / size : 0.,
                        size > 0 ? largest(third, first, n) / size : 0.});
      }
  }



  void
  VerificationAnalysis::write(const Context &context) const
  {
    const auto text = [](const double number) { return number_to_text("%.1e", number); };
    context.log.line("verification: errors of the tangent " + text(error_of_tangent) + ", of damping " +
                     text(error_of_damping) + ", of rates of strains " + text(error_of_rates));
    Table table({"item", "kind", "strains", "motions without strain", "change in rigid motion", "third difference"});
    for (const Row &row : rows)
      {
        table.add_row(
          {row.name, row.kind, row.n_strains, row.n_free_motions, row.change_in_motion, row.third_difference});
        context.log.line("  " + row.kind + " <" + row.name + ">: " + std::to_string(row.n_strains) + " strains, " +
                         std::to_string(row.n_free_motions) + " motions without strain; they change by " +
                         text(row.change_in_motion) + " in a rigid motion; " +
                         (row.third_difference < 1e-9 ? "quadratic: steps in time can keep energy" :
                                                        "not quadratic: steps in time miss energy"));
      }
    if (!context.folder.empty())
      table.write(context.folder + "/verification.csv");
  }



  std::string
  VerificationAnalysis::complaint() const
  {
    // not "larger than": what is not a number is wrong, too
    if (!(std::max(error_of_tangent, error_of_damping) <= tolerance))
      return "the tangent or the damping matrix is not the derivative of the forces: relative error " +
             number_to_text("%.1e", std::max(error_of_tangent, error_of_damping)) + " in " + worst_place;
    if (!(error_of_rates <= tolerance))
      return "rates of strains are not the derivatives of strains: error " + number_to_text("%.1e", error_of_rates);
    for (const Row &row : rows)
      if (!(row.change_in_motion <= tolerance))
        return row.kind + " <" + row.name + "> is strained by a rigid motion, by " +
               number_to_text("%.1e", row.change_in_motion) + " of its strains; what is tied to the ground is";
    return "";
  }
} // namespace samara

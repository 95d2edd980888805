// What the sections along a beam give its elements: stiffness, damping, inertia.

#include <samara/base/text.h>
#include <samara/cosserat/beam.h>
#include <samara/cosserat/section_average.h>
#include <samara/rotation/matrix6.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

namespace samara
{
  Vector6
  Beam::relaxation_times() const
  {
    if (!parameters.is_set("Damping") && !parameters.is_set("Damping ratio"))
      return section->damping();
    Vector6 times;
    for (unsigned int i = 0; i < 6; ++i)
      {
        const double ratio = damping_ratio[damping_ratio.size() == 6 ? i : 0];
        times(i) = viscosity[viscosity.size() == 6 ? i : 0] + (ratio > 0 ? 2 * ratio / damping_frequency : 0.);
      }
    return times;
  }



  Beam::Material
  Beam::material_of(const Matrix6 &stiffness, const Trapeze &trapeze) const
  {
    // symmetric and positive semidefinite also when the six times differ
    const Matrix6 root = relaxation_times().cwiseSqrt().asDiagonal();
    if (!trapeze.is_there())
      return {stiffness, root * stiffness * root};
    return {stiffness - trapeze.coupling * trapeze.coupling.transpose() / trapeze.stiffness, root * stiffness * root};
  }



  std::vector<double>
  Beam::kinks_inside(const Cell &cell) const
  {
    const double        margin = 1e-9 * curve->length(), h = cell.end - cell.start;
    std::vector<double> inside;
    if (!section->kinks().empty())
      for (const double s : kinks)
        if (s > cell.start + margin && s < cell.end - margin)
          inside.push_back((s - cell.start) / h);
    if (inside.empty())
      return {};
    inside.insert(inside.begin(), 0.);
    inside.push_back(1.);
    return inside;
  }



  Vector3
  Beam::initial_curvature(const Cell &cell, const double s) const
  {
    // from the triads a little before and behind, both inside of the element
    const double h = 1e-4 * (cell.end - cell.start), middle = 0.5 * (cell.start + cell.end),
                 at    = std::clamp(s, cell.start + h, cell.end - h);
    const Matrix3 turn = triad_at(at - h, middle).transpose() * triad_at(at + h, middle);
    const Vector3 axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    return axis / (4 * h); // the sine of so small an angle is the angle to 1e-8
  }



  SectionValues
  Beam::section_at(const Cell &cell, const double s) const
  {
    return section->at_side(s / curve->length(),
                            0.5 * (cell.start + cell.end) / curve->length(),
                            section->depends_on_curvature() ? initial_curvature(cell, s) : Vector3(Vector3::Zero()));
  }



  namespace
  {
    constexpr double round_off_of_curvatures = 1e-6, round_off_of_lines = 1e-9;

    /** Of a table of stations whose shapes are linear in between, against one whose numbers are: of √(c_ii c_jj). */
    constexpr double       error_of_lines = 1e-3;
    constexpr unsigned int most_halvings  = 5; // of the way between two stations

    bool
    are_same(const SectionValues &a, const SectionValues &b, const double tolerance)
    {
      // entries have different units: against the diagonal, c_ij²/(c_ii c_jj)
      const auto difference = [](const Matrix6 &x, const Matrix6 &y) {
        const Vector6 scale  = y.diagonal().cwiseAbs().cwiseMax(x.diagonal().cwiseAbs()).cwiseSqrt();
        double        result = 0;
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < 6; ++j)
            if (x(i, j) != y(i, j))
              result = std::max(result, std::abs(x(i, j) - y(i, j)) / (scale(i) * scale(j)));
        return result;
      };
      return difference(a.stiffness, b.stiffness) <= tolerance && difference(a.inertia, b.inertia) <= tolerance;
    }
  } // namespace



  std::vector<Beam::SectionThere>
  Beam::sections_along() const
  {
    const double        L        = curve->length();
    const bool          is_local = section->depends_on_curvature();
    std::vector<double> places   = {0., 1.};
    for (const double x : section->kinks())
      places.push_back(x);
    for (const Cell &cell : cells)
      for (unsigned int k = 1; is_local && k <= cell.degree; ++k)
        places.push_back((cell.start + (cell.end - cell.start) * k / cell.degree) / L);
    const auto seen_from = [&](const double x, const double inside) {
      const auto  has_it = [&](const Cell &cell) { return inside * L <= cell.end; };
      const Cell &cell   = *std::find_if(cells.begin(), cells.end() - 1, has_it);
      return SectionThere{
        x, section->at_side(x, inside, is_local ? initial_curvature(cell, x * L) : Vector3(Vector3::Zero()))};
    };
    // where shapes are linear, numbers are not: as many places as it takes
    const std::function<void(double, double, unsigned int)> add_between =
      [&](const double a, const double b, const unsigned int halvings) {
        const double middle = 0.5 * (a + b);
        if (halvings == most_halvings ||
            are_same(interpolate(seen_from(a, middle).values, seen_from(b, middle).values, 0.5),
                     seen_from(middle, middle).values,
                     error_of_lines))
          return;
        places.push_back(middle);
        add_between(a, middle, halvings + 1);
        add_between(middle, b, halvings + 1);
      };
    const auto in_order = [&]() {
      std::sort(places.begin(), places.end());
      const auto are_one = [](const double a, const double b) { return b - a < 1e-9; };
      places.erase(std::unique(places.begin(), places.end(), are_one), places.end());
    };
    in_order();
    for (unsigned int i = 0, n = places.size(); !section->kinks().empty() && i + 1 < n; ++i)
      add_between(places[i], places[i + 1], 0);
    in_order();

    std::vector<SectionThere> result;
    const auto                add = [&](const SectionThere &next) {
      // a station between two others on whose line it is says nothing
      const auto n = result.size();
      if (n > 1 && result[n - 2].x < result[n - 1].x && result[n - 1].x < next.x)
        {
          const double w = (result[n - 1].x - result[n - 2].x) / (next.x - result[n - 2].x);
          if (are_same(interpolate(result[n - 2].values, next.values, w), result[n - 1].values, round_off_of_lines))
            result.pop_back();
        }
      result.push_back(next);
    };
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        if (i > 0)
          add(seen_from(places[i], 0.5 * (places[i - 1] + places[i])));
        if (i + 1 == places.size())
          continue;
        const SectionThere behind = seen_from(places[i], 0.5 * (places[i] + places[i + 1]));
        if (i == 0 || !are_same(behind.values, result.back().values, round_off_of_curvatures))
          add(behind);
      }
    return result;
  }



  std::vector<Matrix6>
  Beam::stiffnesses_of(const Cell &cell, const ElementTable<1> &of_degree) const
  {
    const auto stiffness = [&](const double xi) {
      return section_at(cell, cell.start + xi * (cell.end - cell.start)).stiffness;
    };
    auto                 breaks = kinks_inside(cell);
    std::vector<Matrix6> result;
    std::vector<double>  points, weights(of_degree.weights.begin(), of_degree.weights.end());
    for (const auto &xi : of_degree.points)
      {
        points.push_back(xi[0]);
        if (breaks.empty())
          result.push_back(stiffness(xi[0]));
      }
    const auto is_first = [&](const Matrix6 &C) { return C == result[0]; };
    if (breaks.empty() && (section->kinks().empty() || (std::all_of(result.begin(), result.end(), is_first) &&
                                                        is_first(stiffness(0.)) && is_first(stiffness(1.)))))
      return result;
    if (breaks.empty())
      breaks = {0., 1.};
    // of the compliance: section forces are smooth where stiffnesses jump
    result.clear();
    const auto compliance = [&](const double xi) { return inverse6(stiffness(xi)); };
    for (const Matrix6 &mean : section_averages(points, weights, breaks, compliance))
      result.push_back(inverse6(mean));
    return result;
  }



  void
  Beam::add_to_sums(const Cell &cell, const ElementTable<1> &of_degree, const std::vector<Matrix6> &stiffnesses)
  {
    // of test forces that are constant, and grow from either end: as polynomials that the rule has without error
    const double L = curve->length(), h = cell.end - cell.start;
    const auto   tests = [&](const double s) {
      const auto power = [&](const double x) { return cell.degree == 1 ? x : x * x; };
      return Vector3(1, power(s / L), power(1 - s / L));
    };
    const auto compliance = [&](const double xi) {
      return inverse6(section_at(cell, cell.start + xi * h).stiffness);
    };
    auto breaks = kinks_inside(cell);
    if (breaks.empty())
      breaks = {0., 1.};
    for (const auto &[xi, weight] : section_rule(breaks, compliance))
      section_sums.exact += h * weight * compliance(xi).diagonal() * tests(cell.start + xi * h).transpose();
    for (unsigned int g = 0; g < of_degree.n_points; ++g)
      section_sums.of_points += h * of_degree.weights[g] * inverse6(stiffnesses[g]).diagonal() *
                                tests(cell.start + of_degree.points[g][0] * h).transpose();
  }



  double
  Beam::error_of_cells()
  {
    std::map<unsigned int, ElementTable<1>> tables;
    section_sums = {};
    for (const Cell &cell : cells)
      {
        const ElementTable<1> &of_degree = tables.try_emplace(cell.degree, cell.degree).first->second;
        add_to_sums(cell, of_degree, stiffnesses_of(cell, of_degree));
      }
    const double error = error_of_sections();
    section_sums       = {};
    return error;
  }



  double
  Beam::error_of_sections() const
  {
    const auto  &exact = section_sums.exact;
    const double most  = exact.maxCoeff();
    return most > 0 ? ((section_sums.of_points - exact).array() / exact.array()).abs().maxCoeff() : 0.;
  }



  std::vector<Remark>
  Beam::remarks() const
  {
    constexpr double none = 1e-12, much = much_error_of_sections;
    const double     error = error_of_sections();
    if (rigid || error < none)
      return {};
    const std::string head = "beam " + name + ": the stiffness of section <" + section_name +
                             "> along its elements is " +
                             (error > much ? "off by up to " + number_to_text("%.2g", 100 * error) + " %" :
                                             "integrated to " + number_to_text("%.1e", error));
    if (error < much)
      return {{Remark::of_check, head}};
    std::vector<double> ends;
    for (const Cell &cell : cells)
      ends.push_back(cell.end);
    const auto is_end = [&](const double s) {
      return s < 1e-9 * curve->length() || std::any_of(ends.begin(), ends.end(), [&](const double end) {
               return std::abs(end - s) < 1e-9 * curve->length();
             });
    };
    const auto n_inside = std::count_if(kinks.begin(), kinks.end(), [&](const double s) { return !is_end(s); });
    return {{Remark::warning,
             head + (n_inside == 0 ?
                       std::string(", where it changes much between stations: give it more <Elements>, or a "
                                   "higher <Degree>") :
                       ", for " + std::to_string(n_inside) + (n_inside == 1 ? " station lies" : " stations lie") +
                         " inside of them. Leave out <Elements>, or give it " +
                         std::to_string(cells.size() + n_inside) + " or more, which end at all stations")}};
  }



  std::vector<Trapeze>
  Beam::trapezes_of(const Cell &cell, const std::vector<Matrix6> &stiffnesses) const
  {
    // as they are at the points, also where stiffnesses are means over an element with kinks inside
    std::vector<Trapeze> result;
    for (unsigned int g = 0; g < stiffnesses.size(); ++g)
      result.push_back(with_margin(section_at(cell, cell.start + table->points[g][0] * (cell.end - cell.start)).trapeze,
                                   stiffnesses[g]));
    return result;
  }



  std::vector<Matrix6>
  Beam::inertias_of(const Cell &cell) const
  {
    const auto inertia = [&](const double xi) {
      return section_at(cell, cell.start + xi * (cell.end - cell.start)).inertia;
    };
    const auto           breaks = kinks_inside(cell);
    std::vector<Matrix6> result;
    std::vector<double>  points, weights(table->node_weights.begin(), table->node_weights.end());
    for (const auto &xi : table->nodes)
      {
        points.push_back(xi[0]);
        if (breaks.empty())
          result.push_back(inertia(xi[0]));
      }
    if (breaks.empty())
      return result;
    // shares of nodes follow each other along the element, but the table has its ends first
    std::vector<unsigned int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) { return points[a] < points[b]; });
    std::vector<double> sorted_points, sorted_weights;
    for (const auto a : order)
      {
        sorted_points.push_back(points[a]);
        sorted_weights.push_back(weights[a]);
      }
    const auto means = section_averages(sorted_points, sorted_weights, breaks, inertia);
    result.resize(points.size());
    for (unsigned int i = 0; i < order.size(); ++i)
      result[order[i]] = means[i];
    return result;
  }



  std::vector<unsigned int>
  Beam::materials_of_cell(const Cell &cell)
  {
    const bool                varies = !section->kinks().empty() || section->depends_on_curvature();
    std::vector<unsigned int> indices(table->n_points, 0);
    if (!materials.empty() && !varies)
      return indices;
    const auto stiffnesses = stiffnesses_of(cell, *table);
    if (!section->kinks().empty())
      add_to_sums(cell, *table, stiffnesses);
    const auto trapezes_at = trapezes_of(cell, stiffnesses);
    for (unsigned int g = 0; g < (varies ? table->n_points : 1); ++g)
      {
        const auto is_last = [&](const Trapeze &last) {
          return last.coupling == trapezes_at[g].coupling && last.stiffness == trapezes_at[g].stiffness;
        };
        if (materials.empty() || stiffnesses[g] != last_stiffness || !is_last(trapezes.back()))
          {
            materials.push_back(material_of(stiffnesses[g], trapezes_at[g]));
            trapezes.push_back(trapezes_at[g]);
          }
        last_stiffness = stiffnesses[g];
        indices[g]     = materials.size() - 1;
      }
    return indices;
  }
} // namespace samara

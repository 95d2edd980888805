// What is known along a beam: probes and drawing.

#include <samara/base/text.h>
#include <samara/cosserat/beam.h>
#include <samara/model/frame_probe.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/extremes_by_name.h>

#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  Beam::Local
  Beam::local(const State &state, const double s, const bool with_strains) const
  {
    // the first cell that ends there or later
    const auto         ends_before = [&](const Cell &cell, const double at) { return cell.end < at; };
    const unsigned int i =
      std::lower_bound(cells.begin(), cells.end() - 1, s - 1e-9 * curve->length(), ends_before) - cells.begin();
    const dealii::Point<1> xi((s - cells[i].start) / (cells[i].end - cells[i].start));

    const ElementTable<1>     &t = *elements[i].table;
    kernel::NodeValues<double> nodes[most_nodes];
    gather(i, state.q.data(), nodes);
    // one for each degree, made when first used
    static thread_local std::map<unsigned int, dealii::FE_Q<1>> elements_of_degree;
    const dealii::FE_Q<1> &fe = elements_of_degree.try_emplace(t.degree, t.degree).first->second;
    Local                  result;
    Sample                &sample = result.sample;
    sample.D.setZero();
    for (unsigned int a = 0; a < t.n_nodes; ++a)
      {
        const double N = fe.shape_value(a, xi);
        if (N == 0.)
          continue; // at another node
        const Vector6 y = elements[i].frames[a].twist(state.y.data());
        sample.x += N * nodes[a].x;
        sample.D += N * nodes[a].D;
        sample.velocity += N * nodes[a].D * y.head<3>();
        result.spin += N * nodes[a].D * y.tail<3>();
        result.acceleration += N * frame_acceleration(elements[i].frames[a], state);
      }
    for (unsigned int k = 0; k < 4; ++k)
      sample.D = renormalised(sample.D);
    result.D_reference  = triad_at(s, 0.5 * (cells[i].start + cells[i].end));
    sample.displacement = sample.x - curve->position(s);

    result.strain.setZero();
    result.stress.setZero();
    if (is_rigid || !with_strains)
      return result;
    // strains and section forces: the polynomial through the Gauss points
    const unsigned int n_points = t.n_points;
    double             e[6 * most_nodes];
    element_strains(i, state.q.data(), e);
    for (unsigned int g = 0; g < n_points; ++g)
      {
        double L = 1;
        for (unsigned int k = 0; k < n_points; ++k)
          if (k != g)
            L *= (xi[0] - t.points[k][0]) / (t.points[g][0] - t.points[k][0]);
        result.strain += L * Eigen::Map<const Vector6>(e + 6 * g);
        const unsigned int number = elements[i].first_point + g;
        result.stress += L * Eigen::Map<const Vector6>(&state.stress[first_strain + 6 * number]);
        if (tension_torsion == nullptr)
          continue;
        result.stress += L * tension_torsion->section_forces(number, state.stress.data());
        result.helical += L * tension_torsion->helical_forces(number, state.stress.data(), e[6 * g + 3]);
      }
    return result;
  }



  std::optional<Probe>
  Beam::probe(const std::string &path) const
  {
    const auto dot      = std::min(path.size(), path.rfind('.'));
    const auto s        = abscissa_of(trim(path.substr(0, dot)));
    const auto quantity = dot < path.size() ? trim(path.substr(dot + 1)) : "";
    if (!s)
      return {};
    const double abscissa = *s;

    static const std::array<std::pair<std::string, std::string>, 4> of_section = {
      {{"force", "N"}, {"moment", "N m"}, {"strain", "1"}, {"curvature", "1/m"}}};
    for (unsigned int k = 0; k < 4; ++k)
      for (unsigned int i = 0; i < 3; ++i)
        if (quantity == of_section[k].first + " " + std::to_string(i + 1))
          return Probe{path, of_section[k].second, [=](const State &state) {
                         const Local l = local(state, abscissa);
                         return (k < 2 ? l.stress : l.strain)(3 * (k % 2) + i);
                       }};

    if (auto of_stresses = stress_probe(path, quantity, abscissa))
      return of_stresses;

    return frame_probe(quantity, [=](const State &state) -> FrameMotion {
      const Local l = local(state, abscissa, false);
      return {l.sample.x,
              l.sample.x - l.sample.displacement,
              l.sample.D,
              l.D_reference,
              l.sample.velocity,
              l.spin,
              l.acceleration.head<3>(),
              l.acceleration.tail<3>()};
    });
  }



  std::pair<std::vector<StressPart>, Vector3>
  Beam::stressed_at(const double s, const std::optional<double> inside) const
  {
    const double L = curve->length(), x = s / L, side = inside.value_or(x);
    const auto   sections = section->stressed(x, side);
    if (sections.empty())
      throw std::invalid_argument("section <" + section_name + "> of beam <" + name +
                                  "> has no stresses: it is not given by its shape and material");
    if (rigid)
      throw std::invalid_argument("beam <" + name + "> is rigid: nothing is known of its stresses");
    const auto    is_here   = [&](const Cell &cell) { return std::max(s, side * L) <= cell.end + 1e-9 * L; };
    const Cell   &cell      = *std::find_if(cells.begin(), cells.end() - 1, is_here);
    const Vector3 curvature = section->depends_on_curvature() ? initial_curvature(cell, s) : Vector3(Vector3::Zero());
    std::vector<StressPart> parts;
    for (const auto &one : sections)
      {
        parts.push_back({one});
        if (!one.is_there)
          parts.back().forces =
            one.shape->values(curvature).stiffness * inverse6(section->at_side(x, side, curvature).stiffness);
      }
    return {parts, curvature};
  }



  double
  Beam::helix_of(const Local &here) const
  {
    return tension_torsion == nullptr ? 0. : 0.5 * here.strain(3) * here.strain(3);
  }



  std::optional<Probe>
  Beam::stress_probe(const std::string &path, const std::string &quantity, const double s) const
  {
    const ExtremeByName wanted(quantity);
    if (!wanted.is_known())
      return {};
    const double x     = s / curve->length();
    auto        &known = probed[x];
    if (known == nullptr)
      {
        const auto [parts, curvature] = stressed_at(s);
        std::vector<BeamStresses::Part> made;
        for (const auto &part : parts)
          made.push_back({part, section_stresses_of(*part.section.shape, curvature)});
        known = std::make_shared<BeamStresses>(made);
      }
    if (wanted.of(known->extremes(Vector6::Zero(), 0)) < 0)
      throw std::invalid_argument("<" + path + "> needs more strengths of a material of section <" + section_name +
                                  "> there");
    return Probe{path, wanted.unit(), [this, s, wanted, stresses = known](const State &state) {
                   const Local here = local(state, s);
                   return wanted.of(stresses->extremes(here.stress - here.helical, helix_of(here)));
                 }};
  }



  std::vector<Doubt>
  Beam::doubts(const State &state) const
  {
    std::vector<Doubt> result;
    for (const auto &[x, stresses] : probed)
      {
        const Local here = local(state, x * curve->length());
        if (const std::string text = stresses->disagreement(here.stress - here.helical, helix_of(here)); !text.empty())
          result.push_back(
            {"stresses at " + number_to_text(x), "Beam " + name + " at " + number_to_text(x) + ": " + text});
      }
    return result;
  }



  Beam::Station
  Beam::station(const State &state, const std::string &point, const std::optional<double> inside) const
  {
    const auto s = abscissa_of(point);
    if (!s)
      throw std::invalid_argument("beam <" + name + "> has no point <" + point + ">" + did_you_mean(point, points()));
    const auto [parts, curvature] = stressed_at(*s, inside);
    const Local here              = local(state, *s);
    return {parts, curvature, here.stress, here.stress - here.helical, helix_of(here), here.sample.x, here.sample.D};
  }



  std::vector<std::string>
  Beam::probe_names() const
  {
    auto quantities = frame_quantities();
    for (const std::string q : {"force", "moment", "strain", "curvature"})
      for (const char i : {'1', '2', '3'})
        quantities.push_back(q + " " + i);
    if (section != nullptr && !rigid && !section->stressed(0, 0).empty())
      {
        const auto of_stresses = ExtremeByName::names();
        quantities.insert(quantities.end(), of_stresses.begin(), of_stresses.end());
      }
    std::vector<std::string> names;
    for (const auto &point : points())
      for (const auto &q : quantities)
        names.push_back(point + "." + q);
    return names;
  }



  void
  Beam::draw(const State &state, Drawing &drawing) const
  {
    std::vector<Sample> axis;
    std::vector<Local>  known;
    std::vector<double> along; // arc lengths as parts of the whole
    std::size_t         n_samples = 1;
    for (const auto &cell : cells)
      n_samples += 2 * cell.degree;
    axis.reserve(n_samples);
    known.reserve(n_samples);
    along.reserve(n_samples);
    for (const auto &cell : cells)
      for (unsigned int k = (&cell == &cells.front() ? 0 : 1); k <= 2 * cell.degree; ++k)
        {
          const double s = cell.start + (cell.end - cell.start) * k / (2 * cell.degree);
          known.push_back(local(state, s));
          axis.push_back(known.back().sample);
          axis.back().spin = known.back().spin;
          along.push_back(s / curve->length());
        }
    drawing.begin_object(name);
    const auto         outline = [&](const unsigned int i) { return section->outline(along[i]); };
    const unsigned int first   = drawing.tube(axis, outline).first_sample;
    if (is_rigid || !drawing.has_fields())
      return; // of the first, strains and section forces of a rigid beam are not known
    Field &force     = drawing.field("section force", "N", inertial_axes);
    Field &moment    = drawing.field("section moment", "N m", inertial_axes);
    Field &strain    = drawing.field("strain", "1", section_axes);
    Field &curvature = drawing.field("curvature", "1/m", section_axes);
    for (unsigned int i = 0; i < axis.size(); ++i)
      {
        const Local &l = known[i];
        force.set(first + i, Vector3(l.sample.D * l.stress.head<3>()));
        moment.set(first + i, Vector3(l.sample.D * l.stress.tail<3>()));
        strain.set(first + i, l.strain.head<3>());
        curvature.set(first + i, l.strain.tail<3>());
      }
  }
} // namespace samara

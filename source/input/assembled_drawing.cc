#include <samara/base/text.h>
#include <samara/input/assembled_drawing.h>
#include <samara/output/table.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  namespace
  {
    /** The bodies of a model with their nodes. */
    std::vector<std::pair<const Body *, unsigned int>>
    bodies_of(const Model &model)
    {
      std::vector<std::pair<const Body *, unsigned int>> bodies;
      for (const auto &item : model.items)
        if (const auto *const body = dynamic_cast<const Body *>(item.get()))
          if (const auto frames = frames_of(*body); !frames.empty())
            bodies.emplace_back(body, frames[0].node);
      return bodies;
    }

    /** What is wrong with a loop that does not close, in words. */
    std::string
    complaint_about(const Assembly &assembly)
    {
      auto   gaps = assembly.gaps();
      double sum  = 0;
      for (const auto &gap : gaps)
        sum += gap.now;
      std::stable_sort(gaps.begin(), gaps.end(), [](const auto &a, const auto &b) { return a.now > b.now; });
      const auto largest_angle =
        *std::max_element(gaps.begin(), gaps.end(), [](const auto &a, const auto &b) { return a.angle < b.angle; });
      std::ostringstream text;
      text << "these bodies cannot be assembled: at best there remain gaps of " << number_to_text("%.4g", sum)
           << " m in all, the largest, " << number_to_text("%.4g", gaps.front().now) << " m, at " << gaps.front().name;
      if (largest_angle.angle > 1e-6)
        text << ", and an angle of " << number_to_text("%.3g", 180 / M_PI * largest_angle.angle)
             << " degrees between axes at " << largest_angle.name;
      const auto loop = assembly.loop();
      if (!loop.empty())
        text << ".\n  Round the loop: " << join(loop, " - ");
      const auto remedies = assembly.remedies();
      for (unsigned int i = 0; i < remedies.size() && i < 4; ++i)
        text << (i == 0 ? "\n  It would close, to first order, with " : "\n  or with ") << remedies[i].what << " "
             << number_to_text("%.7g", remedies[i].length + remedies[i].change) << " m, "
             << number_to_text("%.4g", std::abs(remedies[i].change)) << " m "
             << (remedies[i].change > 0 ? "longer" : "shorter") << " than drawn";
      if (remedies.empty())
        text
          << "\n  No length of a body would mend it: look at the axes of these joints, at <Fixed bodies> and at what is "
             "prescribed";
      return text.str();
    }
  } // namespace



  void
  AssemblySettings::add_parameters(Parameters &prm)
  {
    prm.add("Gaps",
            gaps,
            "Joints whose two points are drawn apart: refused, or the bodies are moved until they meet, as little as "
            "possible. A joint may say so itself by its Gap.",
            dealii::Patterns::Selection("refused|closed"));
    prm.add("Fixed bodies", fixed, "Bodies that stay where they are drawn.");
    prm.add("Weights",
            weights,
            "How much it matters that a body stays where it is drawn: name: weight, name: weight, ...; of others it is "
            "1 [1].");
  }



  AssembledDrawing::AssembledDrawing(System &drawn, const AssemblySettings &settings, const Parameters &entries)
  {
    const Model        &model = drawn.model;
    std::vector<double> weights(drawn.layout.n_nodes, 0.);
    std::vector<bool>   fixed(drawn.layout.n_nodes, false);
    check_and_read(drawn, settings, entries, weights, fixed);
    Assembly   assembly(drawn, weights, fixed);
    const bool closes = assembly.fits() || assembly.close();
    distance          = assembly.distance();
    start             = assembly.start;
    joints            = assembly.gaps();
    double angle      = 0;
    for (const auto &joint : joints)
      {
        drawn_gap = std::max(drawn_gap, joint.drawn);
        gap       = std::max(gap, joint.now);
        angle     = std::max(angle, joint.angle);
      }
    // places and axes are rounded, those of structures, too: what is smaller is taken as it is in drawings that fit
    constexpr double rounding = 1e-5;
    if (!closes && (gap > rounding * assembly.size() || angle > rounding))
      throw InputError(entries.where() + ": " + complaint_about(assembly));
    const State state = drawn.reference();
    for (const auto &[body, node] : bodies_of(model))
      {
        MovedBody moved{body->name, assembly.motion_of(node)};
        moved.angle = Eigen::AngleAxisd(moved.motion.rotation).angle();
        for (const auto &frame : frames_of(*body))
          {
            const Vector3 x = frame.position(state.q.data());
            moved.distance  = std::max(moved.distance, (moved.motion.point(x) - x).norm());
          }
        bodies.push_back(moved);
      }
  }



  void
  AssembledDrawing::check_and_read(const System           &drawn,
                                   const AssemblySettings &settings,
                                   const Parameters       &entries,
                                   std::vector<double>    &weights,
                                   std::vector<bool>      &fixed) const
  {
    Complaints                          complaints;
    std::map<std::string, unsigned int> nodes;
    for (const auto &[body, node] : bodies_of(drawn.model))
      {
        nodes[body->name] = node;
        weights[node]     = std::max(weights[node], 1.);
        fixed[node]       = fixed[node] || body->kind == "shell"; // a mesh cannot be turned
      }
    const auto find = [&](const std::string &name, const std::string &entry) -> const unsigned int * {
      const auto found = nodes.find(name);
      if (found != nodes.end())
        return &found->second;
      std::vector<std::string> names;
      for (const auto &node : nodes)
        names.push_back(node.first);
      complaints.add(entries.where(entry), "there is no body <" + name + ">" + did_you_mean(name, names));
      return nullptr;
    };
    for (const auto &name : settings.fixed)
      if (const auto *const node = find(name, "Fixed bodies"))
        fixed[*node] = true;
    std::map<unsigned int, double> given;
    for (const auto &text : settings.weights)
      {
        const auto   colon  = text.rfind(": ");
        const auto   number = colon == std::string::npos ? "" : trim(text.substr(colon + 2));
        char        *end    = nullptr;
        const double weight = std::strtod(number.c_str(), &end);
        if (number.empty() || *end != '\0' || !(weight > 0) || !std::isfinite(weight))
          complaints.add(entries.where("Weights"),
                         "<" + text + "> is not a name and a weight above zero, <name: weight>");
        else if (const auto *const node = find(trim(text.substr(0, colon)), "Weights"))
          given[*node] = std::max(given[*node], weight);
      }
    for (const auto &[node, weight] : given)
      weights[node] = weight;
    complaints.throw_if_any();
  }



  bool
  AssembledDrawing::has_moved() const
  {
    return std::any_of(bodies.begin(), bodies.end(), [](const auto &b) { return !b.motion.is_identity(); });
  }



  Placement
  AssembledDrawing::motion_of(const std::string &path, const std::string &scope) const
  {
    const std::string name = trim(path.substr(0, path.find('.')));
    for (std::string prefix = scope;; prefix = scope_of(prefix.substr(0, prefix.size() - 1)))
      {
        for (const auto &body : bodies)
          if (body.name == prefix + name)
            return body.motion;
        if (prefix.empty())
          return {}; // the ground
      }
  }



  std::string
  AssembledDrawing::text() const
  {
    constexpr double   degrees = 180 / M_PI;
    std::size_t        width   = 4;
    std::ostringstream out;
    if (!has_moved())
      return "assembly: the drawing fits, nothing has moved";
    for (const auto &body : bodies)
      width = std::max(width, body.name.size());
    const auto cell = [&](const std::string &text) {
      return "\n    " + text + std::string(width + 3 - text.size(), ' ');
    };
    out << "assembly: gaps of up to " << number_to_text("%.4g", drawn_gap)
        << " m are closed; distance from the drawing " << number_to_text("%.4g", distance) << " m";
    if (gap > 1e-9)
      out << "; " << number_to_text("%.2g", gap) << " m are left, as little as places are rounded to";
    if (start > 0)
      out << " (another branch than the drawing leads to: there the gaps stay)";
    out << cell("body") << "moved [m]    turned [deg]";
    for (const auto &body : bodies)
      {
        std::string by = number_to_text("%.4g", body.distance);
        by.resize(std::max<std::size_t>(by.size(), 13), ' ');
        out << cell(body.name) << (body.motion.is_identity() ? "-" : by + number_to_text("%.4g", degrees * body.angle));
      }
    for (const auto &joint : joints)
      if (joint.drawn > 1e-3 * drawn_gap || joint.drawn_angle > 1e-6)
        out << "\n    " << joint.name << ": drawn with a gap of " << number_to_text("%.4g", joint.drawn) << " m"
            << (joint.drawn_angle > 1e-6 ?
                  " and " + number_to_text("%.3g", degrees * joint.drawn_angle) + " degrees between axes" :
                  "");
    return out.str();
  }



  void
  AssembledDrawing::write(const std::string &file) const
  {
    Table table({"body",
                 "displacement [m]",
                 "angle [rad]",
                 "origin x [m]",
                 "origin y [m]",
                 "origin z [m]",
                 "axis x",
                 "axis y",
                 "axis z"});
    for (const auto &body : bodies)
      {
        const Eigen::AngleAxisd turn(body.motion.rotation);
        const Eigen::Vector3d   x = body.motion.origin, axis = turn.axis();
        table.add_row({body.name, body.distance, body.angle, x(0), x(1), x(2), axis(0), axis(1), axis(2)});
      }
    table.write(file);
  }
} // namespace samara

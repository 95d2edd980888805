// Entries of a surface, and its stations.

#include <samara/aero/surface.h>
#include <samara/base/composite_rule.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    Unsteady
    kind_of_unsteady(const std::string &entry)
    {
      return entry == "two lags"      ? Unsteady::two_lags :
             entry == "dynamic stall" ? Unsteady::dynamic_stall :
                                        Unsteady::quasi_steady;
    }
  } // namespace



  /** How lift follows the motion, and what of the air moves along. */
  void
  Surface::add_parameters_of_flow(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add(
      "Unsteady",
      unsteady_name,
      "How lift follows the motion: at once; with two lags a station, states in m/s; or with these and two states of "
      "flow that separates: dynamic stall.",
      Selection("two lags|quasi-steady|dynamic stall"));
    prm.add("Compressible lags",
            compressible_lags,
            "Whether the two lags are slower in fast air, their rates multiplied by 1 - M^2, M not above 0.9.");
    prm.add("Separation lags",
            entered_lags,
            "Of dynamic stall, in half chords that the air passes: of the angle that pressure follows, of the boundary "
            "layer [1].",
            List(Double(1e-3), 2, 2));
    prm.add("Virtual mass",
            has_virtual_mass,
            "Whether the mass of the air moved along counts: needed for flutter, small against the mass of blades. The "
            "damping of pitch is there without it.");
  }



  void
  Surface::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Body", body_name, "Beam or rigid body that carries the surface.");
    prm.add(
      "Line",
      line,
      "On a rigid body: start and end of the reference line in the reference configuration, x, y, z; x, y, z; on a "
      "beam its axis is the line [m].");
    prm.add(
      "Range",
      range,
      "Where the surface starts and ends: abscissae s, arc lengths of the line from its start; not given: all of it "
      "[m].");
    prm.add(
      "Breaks",
      more_breaks,
      "Abscissae where panels end, beside those where chord, twist, offset, lift factor or airfoils have corners [m].");
    prm.add("Stations",
            points_a_panel,
            "Gauss points of each panel, at which loads are computed, shared out among the pieces of it on several "
            "elements. An element has no fewer than its shape functions are of degree: a finer mesh is finer air.",
            Integer(1, 40));
    prm.add("Chord", chord, "Chord, a function of s [m].");
    prm.add("Quarter chord",
            offset,
            "How far the quarter chord lies ahead of the reference line, to the leading edge, a function of s [m].");
    prm.add("Twist",
            twist,
            "Angle of the chord from the direction of the leading edge, positive nose up, a function of s [rad].");
    prm.add(
      "Leading edge",
      leading_edge,
      "Direction near which the leading edge lies seen from the line, reference configuration; 0, 0, 0: axis 2 of the "
      "body, which on a beam turns with its twist [1].");
    prm.add(
      "Upper side",
      upper_side,
      "Direction to which the upper side looks, reference configuration; 0, 0, 0: that of line times leading edge [1].");
    prm.add("Airfoils",
            airfoil_names,
            "Airfoil; or airfoils along the span, blended between: name at s, name at s, ...");
    add_parameters_of_flow(prm);
    prm.add("Lift factor", lift_factor, "What lift is multiplied by, a function of s: losses at tips [1].");
    prm.add("Inflow", inflow_name, "Name of the inflow in which the surface moves; empty: none.");
    prm.add("Air", air_name, "Name of the air; needed only if there are several.");
    prm.turns("Line", Turning::position);
    prm.turns("Leading edge", Turning::direction);
    prm.turns("Upper side", Turning::direction);
  }



  void
  Surface::be_moved(const MotionOf &motion_of)
  {
    be_placed(motion_of(body_name));
  }



  void
  Surface::choose_unsteady()
  {
    unsteady        = kind_of_unsteady(unsteady_name);
    separation_lags = {entered_lags[0], entered_lags[1]};
    if (unsteady == Unsteady::quasi_steady && compressible_lags)
      model->complaints.add(parameters.where("Compressible lags"), "<Unsteady = quasi-steady> has no lags");
    if (unsteady != Unsteady::dynamic_stall && entered_lags != std::vector<double>{1.7, 3.})
      model->complaints.add(parameters.where("Separation lags"), "<Unsteady = dynamic stall> alone has them");
  }



  void
  Surface::initialize(Model &m)
  {
    model             = &m;
    const auto before = model->complaints.count();
    for (const std::string entry : {"Body", "Chord", "Airfoils"})
      parameters.require(entry, model->complaints);
    if (model->complaints.count() != before)
      return;
    choose_unsteady();
    std::string where = "Air";
    try
      {
        air   = &Air::of(*model, air_name);
        where = "Inflow";
        if (!inflow_name.empty())
          inflow = &model->find<Inflow>(inflow_name, "inflow");
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where(where), problem.what());
      }
    if (find_airfoils() && find_body() && model->complaints.count() == before)
      add_stations();
    if (inflow != nullptr)
      {
        if (model->complaints.count() == before)
          check_disk();
        inflow->surfaces.push_back(this);
      }
    if (model->complaints.count() != before)
      return;
    where = "Chord";
    try
      {
        if (has_virtual_mass)
          for (auto &element : elements)
            find_virtual_mass(element);
        where = "Unsteady";
        for (auto &element : elements)
          for (auto &station : element.stations)
            add_states(station, element);
        where = "Inflow";
        join_inflow();
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where(where), problem.what());
        return;
      }
    find_doubts();
  }



  /** Inflows of others, and annular ones, know each station by its place. */
  void
  Surface::join_inflow()
  {
    if (auto *const flow = dynamic_cast<ExternalInflow *>(inflow))
      {
        external = flow;
        for (const auto &element : elements)
          for (const auto &station : element.stations)
            flow->add_station(on_disk(station, element), station.weight);
      }
    if (auto *const flow = dynamic_cast<AnnularInflow *>(inflow))
      {
        annular = flow;
        for (auto &element : elements)
          for (auto &station : element.stations)
            add_flow(station, element, *flow);
      }
  }



  bool
  Surface::find_airfoils()
  {
    try
      {
        if (airfoil_names.size() == 1)
          {
            std::string airfoil, place;
            double      s = 0;
            if (!split_at(airfoil_names[0], airfoil, place) || !text_to_number(place, s))
              airfoil = airfoil_names[0];
            airfoils = {{&model->find<Airfoil>(airfoil, "airfoil"), 0.}};
            return true;
          }
        for (const auto &text : airfoil_names)
          {
            std::string airfoil, place;
            double      s = 0;
            if (!split_at(text, airfoil, place) || !text_to_number(place, s))
              throw std::invalid_argument("an airfoil of several is written <name at s>, s in metres, not <" + text +
                                          ">");
            if (!airfoils.empty() && !(s > airfoils.back().s))
              throw std::invalid_argument("airfoils stand in the order of their abscissae: <" + text + ">");
            airfoils.push_back({&model->find<Airfoil>(airfoil, "airfoil"), s});
          }
        return !airfoils.empty();
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where("Airfoils"), problem.what());
        return false;
      }
  }



  bool
  Surface::find_body()
  {
    std::string where = "Body";
    try
      {
        const Body &body  = model->find<Body>(body_name, "body");
        const auto  spans = body.spans();
        where             = "Line";
        if (!spans.empty() && !line.empty())
          throw std::invalid_argument("the line of a surface on a beam is its axis; <Line> is for rigid bodies");
        for (const auto &span : spans)
          elements.push_back({span.frames, span.abscissae, {}, {}});
        if (!spans.empty())
          return true;
        if (line.size() != 2 || (line[1] - line[0]).isZero(0.))
          throw std::invalid_argument("a surface on a rigid body needs a <Line> from one point to another");
        // the frame of the body at the start of the line
        const Frame frame = body.frame("");
        elements          = {{{model->frame_at(frame, line[0], model->triad(frame))}, {0.}, {}, {}}};
        return true;
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where(where), problem.what());
        return false;
      }
  }



  namespace
  {
    void
    add_corners(const Expression &f, const double from, const double to, std::vector<double> &breaks)
    {
      for (double s = f.next_corner(from, to); s < to; s = f.next_corner(s, to))
        breaks.push_back(s);
    }
  } // namespace



  /** Where panels end. @throws std::invalid_argument */
  std::vector<double>
  Surface::breaks() const
  {
    double start = 0, end = line.size() == 2 ? (line[1] - line[0]).norm() : 0;
    for (const auto &element : elements)
      end = std::max(end, *std::max_element(element.abscissae.begin(), element.abscissae.end()));
    const double length = end;
    if (!range.empty())
      {
        if (range.size() != 2 || !(range[1] > range[0]) || range[0] < -1e-9 * length || range[1] > (1 + 1e-9) * length)
          throw std::invalid_argument("<Range> says where the surface starts and ends, between 0 and " +
                                      number_to_text("%.6g", length) + " m");
        start = std::max(0., range[0]);
        end   = std::min(length, range[1]);
      }
    std::vector<double> result = {start, end};
    for (const auto *f : {&chord, &offset, &twist, &lift_factor})
      add_corners(*f, start, end, result);
    for (const auto &airfoil : airfoils)
      if (airfoils.size() > 1 && airfoil.s > start && airfoil.s < end)
        result.push_back(airfoil.s);
    for (const double s : more_breaks)
      if (s < start - 1e-9 * length || s > end + 1e-9 * length)
        throw std::invalid_argument("the break at " + number_to_text(s) +
                                    " m is outside of the surface, which is from " + number_to_text("%.6g", start) +
                                    " to " + number_to_text("%.6g", end) + " m");
      else
        result.push_back(std::min(end, std::max(start, s)));
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(),
                             result.end(),
                             [=](const double a, const double b) { return b - a < 1e-9 * length; }),
                 result.end());
    return result;
  }



  /** The element in which a place lies: the last that begins before it. */
  unsigned int
  Surface::element_at(const double s) const
  {
    unsigned int i = 0;
    while (i + 1 < elements.size() && elements[i + 1].abscissae.front() <= s)
      ++i;
    return i;
  }



  /** Gauss points of the panels, each divided where elements end. */
  std::vector<RulePoint>
  Surface::rule() const
  {
    constexpr double       round_off = 1e-9;
    std::vector<RulePoint> result;
    for (unsigned int k = 0; k + 1 < panels.size(); ++k)
      {
        const double        length = panels[k + 1] - panels[k];
        std::vector<double> ends   = {panels[k]};
        for (const auto &element : elements)
          if (const double s = element.abscissae.front();
              s > ends.back() + round_off * length && s < panels[k + 1] - round_off * length)
            ends.push_back(s);
        ends.push_back(panels[k + 1]);
        for (unsigned int i = 0; i + 1 < ends.size(); ++i)
          {
            const double piece      = ends[i + 1] - ends[i];
            const auto  &nodes      = elements[element_at(0.5 * (ends[i] + ends[i + 1]))].abscissae;
            const double degree     = nodes.size() - 1.,
                         of_element = *std::max_element(nodes.begin(), nodes.end()) - nodes.front();
            // p points integrate degree 2p - 1: as much as keeps the order of elements of degree p
            double n = points_a_panel * piece / length;
            if (degree > 0)
              n = std::max(n, degree * piece / of_element);
            const auto points = composite_rule({ends[i], ends[i + 1]}, std::max(1., std::ceil((1 - round_off) * n)));
            result.insert(result.end(), points.begin(), points.end());
          }
      }
    return result;
  }



  void
  Surface::add_stations()
  {
    std::string where = "Breaks";
    try
      {
        panels = breaks();
        where  = "Chord";
        for (const auto &point : rule())
          {
            const unsigned int i = element_at(point.x);
            elements[i].stations.push_back(station_at(point.x, point.weight, elements[i]));
          }
      }
    catch (const std::invalid_argument &problem)
      {
        if (where == "Breaks" && !range.empty() && std::string(problem.what()).rfind("<Range>", 0) == 0)
          where = "Range";
        model->complaints.add(parameters.where(where), problem.what());
      }
    elements.erase(std::remove_if(elements.begin(),
                                  elements.end(),
                                  [this](const Element &e) { return e.stations.empty() && !has_virtual_mass; }),
                   elements.end());
    find_places();
  }



  namespace
  {
    /** Derivative of lagrange() by @p x. */
    double
    lagrange_slope(const std::vector<double> &nodes, const unsigned int a, const double x)
    {
      double sum = 0;
      for (unsigned int c = 0; c < nodes.size(); ++c)
        if (c != a)
          {
            double product = 1 / (nodes[a] - nodes[c]);
            for (unsigned int b = 0; b < nodes.size(); ++b)
              if (b != a && b != c)
                product *= (x - nodes[b]) / (nodes[a] - nodes[b]);
            sum += product;
          }
      return sum;
    }

    /** The two airfoils on both sides of @p s, and the share of the second. */
    template <typename Placed>
    void
    blend(const std::vector<Placed> &airfoils, const double s, SectionOfWing &section)
    {
      Assert(!airfoils.empty(), dealii::ExcMessage("A station has an airfoil."));
      unsigned int i = 0;
      while (i + 2 < airfoils.size() && airfoils[i + 1].s <= s)
        ++i;
      section.airfoil = airfoils[i].airfoil;
      if (airfoils.size() > 1)
        {
          section.next  = airfoils[i + 1].airfoil;
          section.share = std::min(1., std::max(0., (s - airfoils[i].s) / (airfoils[i + 1].s - airfoils[i].s)));
        }
    }
  } // namespace



  namespace
  {
    /** Whether it has lift anywhere within 20 degrees of zero: a cylinder, a rod has none. */
    bool
    lifts(const SectionOfWing &section)
    {
      constexpr double step = M_PI / 180, no_lift = 0.05; // as of a blend with one part of an airfoil in forty
      constexpr int    most = 20;
      for (int i = -most; i <= most; ++i)
        if (std::abs(section.coefficients(i * step, 0.).lift) > no_lift)
          return true;
      return false;
    }
  } // namespace



  /** @throws std::invalid_argument if its chord has no length, or no direction */
  Station
  Surface::station_at(const double s, const double weight, const Element &element) const
  {
    Station station;
    station.s      = s;
    station.weight = weight;
    Vector3 x = Vector3::Zero(), tangent = Vector3::Zero();
    Matrix3 F = Matrix3::Zero();
    for (unsigned int a = 0; a < element.frames.size(); ++a)
      {
        station.N.push_back(lagrange(element.abscissae, a, s));
        const Vector3 x_a = model->position(element.frames[a]);
        x += station.N[a] * x_a;
        tangent += lagrange_slope(element.abscissae, a, s) * x_a;
        F += station.N[a] * model->triad(element.frames[a]);
      }
    const Vector3 axis = x; // what moves with the frames; on a rigid body the line is elsewhere
    if (!line.empty())
      {
        tangent = line[1] - line[0];
        x       = line[0] + s * tangent.normalized();
      }

    const std::string here = " at s = " + number_to_text("%.6g", s) + " m";
    station.section.chord  = chord(s);
    if (!(station.section.chord > 0) || !std::isfinite(station.section.chord))
      throw std::invalid_argument("the chord must be positive, and is " +
                                  number_to_text("%.6g", station.section.chord) + " m" + here);
    Vector3       e1     = tangent.normalized();
    const Vector3 ahead  = leading_edge.isZero(0.) ? Vector3(F.col(1)) : leading_edge,
                  across = ahead - e1 * e1.dot(ahead);
    if (across.norm() < 1e-6 * ahead.norm())
      throw std::invalid_argument("the leading edge lies in the direction of the reference line" + here +
                                  ": say with <Leading edge> where it is");
    Vector3 e2 = across.normalized(), e3 = e1.cross(e2);
    if (!upper_side.isZero(0.))
      {
        if (std::abs(e3.dot(upper_side)) < 1e-6 * upper_side.norm())
          throw std::invalid_argument("the upper side looks neither up nor down" + here +
                                      ": <Upper side> lies in the plane of line and leading edge");
        if (e3.dot(upper_side) < 0)
          {
            e3 = -e3;
            e1 = -e1;
          }
      }
    const double  angle    = twist(s);
    const Vector3 nose     = std::cos(angle) * e2 + std::sin(angle) * e3;
    const Matrix3 into_F   = F.inverse();
    station.along          = into_F * e1;
    station.chordwise      = into_F * nose;
    station.quarter        = into_F * (x - axis + offset(s) * nose);
    station.three_quarters = into_F * (x - axis + (offset(s) - 0.5 * station.section.chord) * nose);

    station.section.lift_factor = lift_factor(s);
    blend(airfoils, s, station.section);
    station.lifts  = lifts(station.section);
    const double c = station.section.chord;
    if (station.lifts)
      station.pitch_damping = station.section.lift_factor * M_PI / 16 * air->density * c * c * c;
    return station;
  }



  namespace
  {
    /** Where the span of an element ends; its nodes may stand in any order. */
    double
    end_of(const std::vector<double> &abscissae)
    {
      return *std::max_element(abscissae.begin(), abscissae.end());
    }

    /** Value at @p x of the piecewise linear function that is 1 at node @p a and 0 at the other @p nodes. */
    double
    hat(const std::vector<double> &nodes, const unsigned int a, const double x)
    {
      double value = 1;
      for (const double other : nodes)
        if ((other < nodes[a] && x < nodes[a]) || (other > nodes[a] && x > nodes[a]))
          value = std::min(value, std::max(0., (x - other) / (nodes[a] - other)));
      return value;
    }
  } // namespace



  /**
   * The virtual mass at the nodes of an element, by its shape functions, which are exact for what varies slowly; or by
   * piecewise linear ones, which are nowhere negative and keep mass and centre. Whether no node has a negative mass.
   */
  bool
  Surface::lump_virtual_mass(Element &element, const bool piecewise) const
  {
    constexpr unsigned int n_points = 10; // exact for (chord)⁴ times shape functions up to degree 11
    const unsigned int     n        = element.frames.size();
    element.virtual_mass.assign(n, Matrix6::Zero());
    // the part of each panel that is on the element, whatever stations there are
    const auto         &nodes = element.abscissae;
    const double        end   = n > 1 ? end_of(nodes) : panels.back();
    std::vector<double> pieces;
    for (const double s : panels)
      pieces.push_back(std::min(end, std::max(nodes.front(), s)));
    if (piecewise)
      pieces.insert(pieces.end(), nodes.begin(), nodes.end());
    std::sort(pieces.begin(), pieces.end());
    std::vector<double> mass(n, 0.), inertia(n, 0.);
    double              total_mass = 0, total_inertia = 0;
    for (const auto &point : composite_rule(pieces, n_points))
      {
        if (point.weight == 0 || point.x < panels.front() || point.x > panels.back())
          continue;
        const Station station = station_at(point.x, point.weight, element);
        const double  c = station.section.chord, m = station.weight * M_PI / 4 * air->density * c * c;
        // v₃ of the half chord and Ω₁ of a frame's twist
        const Vector3 e1 = station.along, e3 = e1.cross(station.chordwise);
        Vector6       v3, spin               = Vector6::Zero();
        v3 << e3, station.middle().cross(e3);
        spin.tail<3>()  = e1;
        const Matrix6 M = m * (v3 * v3.transpose() + c * c / 32 * spin * spin.transpose());
        for (unsigned int a = 0; a < n; ++a)
          {
            const double N = piecewise ? hat(nodes, a, point.x) : station.N[a];
            element.virtual_mass[a] += N * M;
            mass[a] += N * m;
            inertia[a] += N * m * c * c;
          }
        total_mass += m;
        total_inertia += m * c * c;
      }
    const auto is_positive = [](const std::vector<double> &parts, const double total) {
      constexpr double round_off = 1e-9;
      return *std::min_element(parts.begin(), parts.end()) >= -round_off * total;
    };
    return is_positive(mass, total_mass) && is_positive(inertia, total_inertia);
  }



  void
  Surface::find_virtual_mass(Element &element)
  {
    for (auto &station : element.stations)
      station.virtual_mass = M_PI / 4 * air->density * station.section.chord * station.section.chord;
    // shape functions are negative in places: where the chord tapers fast, or the surface ends within an element
    if (!lump_virtual_mass(element, false))
      lump_virtual_mass(element, true);
    for (unsigned int a = 0; a < element.frames.size(); ++a)
      model->add_inertia(element.frames[a], element.virtual_mass[a]);
  }



  void
  Surface::add_virtual_mass(std::vector<Matrix6> &of_nodes) const
  {
    for (const auto &element : elements)
      for (unsigned int a = 0; a < element.virtual_mass.size(); ++a)
        {
          const Frame  &frame = element.frames[a];
          const Matrix6 T     = twist_transfer(frame.arm, frame.rotation);
          of_nodes[frame.node] += T.transpose() * element.virtual_mass[a] * T;
        }
  }



  void
  Surface::connect(Layout &layout)
  {
    for (auto &element : elements)
      {
        for (auto &frame : element.frames)
          frame = layout.model.resolved(frame);
        std::vector<Frame>        frames = element.frames;
        std::vector<unsigned int> states = element.lags;
        if (inflow != nullptr)
          {
            frames.push_back(inflow->hub);
            states.insert(states.end(), inflow->states.begin(), inflow->states.end());
            const auto others = inflow->neighbour_states();
            states.insert(states.end(), others.begin(), others.end());
          }
        layout.couple(element.block, frames, {}, {}, states);
      }
    add_doubt_of_twins(); // which may stand behind it
    loads.surface = rates.surface = this;
    layout.add(*this, loads);
    if (states_of(unsteady) > 0 || annular != nullptr || (inflow != nullptr && !inflow->states.empty()))
      layout.add(*this, rates);
  }
} // namespace samara

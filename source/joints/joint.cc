#include <samara/joints/joint.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  FreeMotion::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    if (is_angle())
      {
        prm.add("Spring", spring, "Stiffness [N*m/rad].", Double(0));
        prm.add("Rest", rest, "Angle at which the spring is free of moment [rad].");
        prm.add("Damper", damper, "Viscous damping [N*m*s/rad].", Double(0));
        prm.add("Lower stop", lower_stop, "Angle below which a stop is touched; not given: there is none [rad].");
        prm.add("Upper stop", upper_stop, "Angle above which a stop is touched; not given: there is none [rad].");
        prm.add("Stop stiffness", stop_stiffness, "Stiffness of the stops [N*m/rad].", Double(0));
        prm.add("Stop damping", stop_damping, "Viscous damping while a stop is touched [N*m*s/rad].", Double(0));
        prm.add("Moment", force, "Moment on body B, its reaction on body A; a function of time t [N*m].");
        prm.add("Prescribed", prescribed, "Prescribed angle of B seen from A; a function of time t [rad].");
      }
    else
      {
        prm.add("Spring", spring, "Stiffness [N/m].", Double(0));
        prm.add("Rest", rest, "Displacement at which the spring is free of force [m].");
        prm.add("Damper", damper, "Viscous damping [N*s/m].", Double(0));
        prm.add("Lower stop", lower_stop, "Displacement below which a stop is touched; not given: there is none [m].");
        prm.add("Upper stop", upper_stop, "Displacement above which a stop is touched; not given: there is none [m].");
        prm.add("Stop stiffness", stop_stiffness, "Stiffness of the stops [N/m].", Double(0));
        prm.add("Stop damping", stop_damping, "Viscous damping while a stop is touched [N*s/m].", Double(0));
        prm.add("Force", force, "Force on body B, its reaction on body A; a function of time t [N].");
        prm.add("Prescribed", prescribed, "Prescribed displacement of B seen from A; a function of time t [m].");
      }
  }



  void
  FreeMotion::check_parameters(const Parameters &prm, Complaints &complaints)
  {
    is_prescribed  = prm.is_set("Prescribed");
    has_lower_stop = prm.is_set("Lower stop");
    has_upper_stop = prm.is_set("Upper stop");
    if ((has_lower_stop || has_upper_stop) && stop_stiffness == 0.)
      complaints.add(prm.where(prm.is_set("Stop stiffness") ? "Stop stiffness" :
                               has_upper_stop               ? "Upper stop" :
                                                              "Lower stop"),
                     "the stop of the " + name + " needs a <Stop stiffness> above zero");
    if (has_lower_stop && has_upper_stop && lower_stop >= upper_stop)
      complaints.add(prm.where("Upper stop"), "the <Upper stop> of the " + name + " must be above its <Lower stop>");
  }



  bool
  FreeMotion::is_used() const
  {
    return spring != 0 || damper != 0 || !force.is_zero() || is_prescribed || has_lower_stop || has_upper_stop;
  }



  std::optional<std::array<Frame, 2>>
  ends_of_joint(Model &model, const Contribution &joint, const std::string &body_a, const std::string &body_b)
  {
    std::array<Frame, 2> ends;
    bool                 are_known = true;
    for (unsigned int i = 0; i < 2; ++i)
      {
        const std::string entry = i == 0 ? "Body A" : "Body B";
        try
          {
            if (joint.parameters.require(entry, model.complaints))
              ends[i] = model.frame(i == 0 ? body_a : body_b);
            else
              are_known = false;
          }
        catch (const std::invalid_argument &problem)
          {
            model.complaints.add(joint.parameters.where(entry), problem.what());
            are_known = false;
          }
      }
    if (!are_known)
      return {};
    if (ends[0].node != ends[1].node)
      return ends;
    // a body that could not be made has complained already; its frames are those of the ground
    if (ends[0].node != 0 || (body_a == "ground" && body_b == "ground"))
      model.complaints.add(joint.parameters.where("Body B"),
                           "joint <" + joint.name + "> connects a body to itself: <" + body_a + "> and <" + body_b +
                             "> cannot move against each other");
    return {};
  }



  bool
  check_ends(Model &model, const Contribution &joint, const Frame &a, const Frame &b, const std::string &between)
  {
    if (a.node != b.node)
      return true;
    model.complaints.add(joint.parameters.where("Body B"),
                         "joint <" + joint.name + ">: " + between + " are " +
                           (a.node == 0 ? "both welded to the ground" : "welded together") +
                           " by rigid joints and cannot move against each other");
    return false;
  }



  void
  Joint::add_parameters(Parameters &prm)
  {
    prm.add("Body A", body_a, "First frame: body.point, or ground.");
    prm.add("Body B", body_b, "Second frame; relative motions are those of B seen from A.");
    prm.add("Position", position, "Place of the joint in the reference configuration; default: that of frame B [m].");
    prm.add("Axis", axis, "Direction of joint axis 3 in the reference configuration, inertial components [1].");
    prm.add("Axis 1", axis_1, "Direction near which joint axis 1 lies; 0, 0, 0: any [1].");
    for (auto &motion : free)
      motion.add_parameters(prm.subsection(motion.name));
  }



  void
  Joint::lock_displacement(const unsigned int i)
  {
    locked.push_back({{PairFunction::gap, i}, "displacement " + std::to_string(i + 1), 0., i});
  }



  void
  Joint::lock_rotation(const unsigned int i, const unsigned int j)
  {
    // the multiplier is a moment of B on A about E_j × E_i, which is plus or minus the third axis
    const unsigned int k    = 3 - i - j;
    const double       sign = (i + 1) % 3 == j ? 1. : -1.;
    locked.push_back({{PairFunction::cosine, i, j}, "rotation " + std::to_string(k + 1), 0., k, sign});
  }



  FreeMotion &
  Joint::free_displacement(const unsigned int i, const std::string &name)
  {
    free.emplace_back();
    free.back().name  = name;
    free.back().unit  = "m";
    free.back().first = {PairFunction::gap, i};
    free.back().axis  = i;
    return free.back();
  }



  FreeMotion &
  Joint::free_rotation_about_3(const std::string &name)
  {
    free.emplace_back();
    free.back().name   = name;
    free.back().unit   = "rad";
    free.back().first  = {PairFunction::cosine, 0, 0};
    free.back().second = {PairFunction::cosine, 1, 0};
    return free.back();
  }



  Matrix3
  Joint::axes() const
  {
    if (axis.isZero(0.))
      throw std::invalid_argument("the axis must not be zero");
    return triad_about(axis, axis_1);
  }



  void
  Joint::place(Model &model, const Frame &a, const Frame &b)
  {
    if (!parameters.is_set("Position"))
      position = model.position(b);
    const Matrix3 E = axes();
    frame_a         = model.frame_at(a, position, E);
    frame_b         = model.frame_at(b, position, E);
  }



  void
  Joint::complain(Model &model, const std::string &entry, const std::string &text) const
  {
    model.complaints.add(parameters.where(entry), text);
  }



  void
  Joint::initialize(Model &m)
  {
    model           = &m;
    const auto ends = ends_of_joint(m, *this, body_a, body_b);
    if (!ends)
      return;
    try
      {
        place(m, (*ends)[0], (*ends)[1]);
      }
    catch (const std::invalid_argument &problem)
      {
        return complain(m, "Axis", problem.what());
      }
    for (auto &motion : free)
      {
        motion.check_parameters(parameters.subsection(motion.name), m.complaints);
        if (motion.is_used() || is_screw)
          use_coordinate(m, motion.name);
      }
  }



  std::optional<unsigned int>
  Joint::use_coordinate(Model &model, const std::string &wanted)
  {
    for (auto &motion : free)
      if (motion.name == wanted || (wanted.empty() && free.size() == 1))
        {
          if (motion.coordinate < 0)
            motion.coordinate = model.add_coordinate(name + "." + motion.name, motion.unit);
          return motion.coordinate;
        }
    return {};
  }



  std::vector<std::string>
  Joint::rotation_names() const
  {
    std::vector<std::string> names;
    for (const auto &motion : free)
      if (motion.is_angle())
        names.push_back(motion.name);
    return names;
  }



  void
  Joint::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (!check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      return;
    rows.clear();
    for (const auto &l : locked)
      rows.push_back("joint " + name + ", " + l.name);
    std::vector<unsigned int> coordinates;
    for (auto &motion : free)
      if (motion.coordinate >= 0)
        {
          used.push_back(&motion);
          coordinates.push_back(motion.coordinate);
          rows.push_back("joint " + name + ", measure of the " + motion.name);
        }
    for (const auto *motion : used)
      if (motion->is_prescribed)
        rows.push_back("joint " + name + ", prescribed " + motion->name);
    if (is_screw)
      rows.push_back("joint " + name + ", pitch");
    for (const auto &s : no_slip)
      rows.push_back("joint " + name + ", " + s.name);
    for (unsigned int i = 0; i < used.size(); ++i)
      {
        if (used[i]->has_lower_stop)
          stops.push_back({i, used[i]->lower_stop, -1.});
        if (used[i]->has_upper_stop)
          stops.push_back({i, used[i]->upper_stop, 1.});
      }

    first_multiplier = layout.add_multipliers(rows);
    std::vector<unsigned int> multipliers(rows.size());
    for (unsigned int i = 0; i < rows.size(); ++i)
      multipliers[i] = first_multiplier + i;
    layout.couple(block, {frame_a, frame_b}, coordinates, multipliers);
    unsigned int row = first_multiplier + locked.size() + used.size();
    for (const auto *motion : used)
      if (motion->is_prescribed)
        model->prescribed[motion->coordinate] = row++;
    for (unsigned int i = 0; i < used.size(); ++i)
      if (used[i]->is_angle() && !used[i]->is_prescribed)
        layout.corrections.push_back({first_multiplier + static_cast<unsigned int>(locked.size()) + i,
                                      static_cast<unsigned int>(used[i]->coordinate)});
    for (unsigned int i = rows.size() - no_slip.size(); i < rows.size(); ++i)
      layout.nonholonomic.push_back(multipliers[i]);
  }



  unsigned int
  Joint::n_strains() const
  {
    return used.size() + stops.size();
  }



  unsigned int
  Joint::n_switches() const
  {
    return stops.size();
  }



  void
  Joint::switch_values(const Point<double> &point, double *values) const
  {
    for (unsigned int i = 0; i < stops.size(); ++i)
      values[i] = stops[i].side * (point.coordinates[used[stops[i].motion]->coordinate] - stops[i].place);
  }



  double
  Joint::next_corner(const double from, const double to) const
  {
    double corner = std::numeric_limits<double>::infinity();
    for (const auto *m : used)
      corner = std::min({corner, m->force.next_corner(from, to), m->prescribed.next_corner(from, to)});
    return corner;
  }



  template <typename Number>
  double
  Joint::touches(const Point<Number> &point, const unsigned int i) const
  {
    return point.switches != nullptr && point.switches[first_switch + i] != 0 ? 1. : 0.;
  }



  template <typename Number>
  void
  Joint::strains_at(const Point<Number> &point, Number *e) const
  {
    for (unsigned int i = 0; i < used.size(); ++i)
      e[i] = point.coordinates[used[i]->coordinate] - used[i]->rest;
    for (unsigned int i = 0; i < stops.size(); ++i)
      e[used.size() + i] = touches(point, i) * (point.coordinates[used[stops[i].motion]->coordinate] - stops[i].place);
  }



  void
  Joint::strain_rates(const Point<double> &point, double *rates) const
  {
    for (unsigned int i = 0; i < used.size(); ++i)
      rates[i] = point.rates[used[i]->coordinate];
    for (unsigned int i = 0; i < stops.size(); ++i)
      rates[used.size() + i] = touches(point, i) * point.rates[used[stops[i].motion]->coordinate];
  }



  template <typename Number>
  void
  Joint::stresses_of(const Number *e, const Number *rates, Number *stress) const
  {
    for (unsigned int i = 0; i < used.size(); ++i)
      stress[i] = used[i]->spring * e[i] + used[i]->damper * rates[i];
    for (unsigned int i = 0; i < stops.size(); ++i)
      {
        const FreeMotion  &m = *used[stops[i].motion];
        const unsigned int k = used.size() + i;
        stress[k]            = m.stop_stiffness * e[k] + m.stop_damping * rates[k];
      }
  }



  double
  Joint::strain_energy(const double *e) const
  {
    double energy = 0;
    for (unsigned int i = 0; i < used.size(); ++i)
      energy += 0.5 * used[i]->spring * e[i] * e[i];
    for (unsigned int i = 0; i < stops.size(); ++i)
      energy += 0.5 * used[stops[i].motion]->stop_stiffness * std::pow(e[used.size() + i], 2);
    return energy;
  }



  template <typename Number>
  Number
  Joint::measure(const FreeMotion &motion, const PairValues<Number> &pair, const Number &value) const
  {
    if (motion.is_length())
      return 0.5 / motion.reference * (motion.first.value(pair) - (value + motion.reference) * (value + motion.reference));
    if (!motion.is_angle())
      return motion.first.value(pair) - value;
    return sin(value) * motion.first.value(pair) - cos(value) * motion.sign * motion.second.value(pair);
  }



  template <typename Number>
  void
  Joint::residual_at(const Point<Number> &point, Number *r) const
  {
    using std::cos;
    using std::sin;
    const PairValues<Number>                 pair(frame_a, frame_b, point.q);
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local     = Eigen::Matrix<Number, Eigen::Dynamic, 1>::Zero(block.size());
    const Number                            *lambda    = point.multipliers + first_multiplier;
    const Number                            *stress    = point.stress + first_strain;
    const unsigned int                       first_row = 12 + used.size();
    unsigned int                             row       = 0;

    for (const auto &l : locked)
      {
        local(first_row + row) = l.function.value(pair) - l.value;
        l.function.add_gradient(pair, lambda[row++], local.template head<12>());
      }
    for (unsigned int i = 0; i < used.size(); ++i)
      {
        const FreeMotion &m     = *used[i];
        const Number      value = point.coordinates[m.coordinate];
        local(first_row + row)  = measure(m, pair, value);
        local(12 + i) += stress[i] - point.factor * m.force(point.time);
        if (m.is_angle())
          {
            const Number s = sin(value), c = cos(value);
            m.first.add_gradient(pair, Number(lambda[row] * s), local.template head<12>());
            m.second.add_gradient(pair, Number(-lambda[row] * c * m.sign), local.template head<12>());
            local(12 + i) += lambda[row] * (c * m.first.value(pair) + s * m.sign * m.second.value(pair));
          }
        else
          {
            m.first.add_gradient(pair, Number(m.scale() * lambda[row]), local.template head<12>());
            local(12 + i) -= lambda[row] * m.lever(value);
          }
        ++row;
      }
    for (unsigned int i = 0; i < used.size(); ++i)
      if (used[i]->is_prescribed)
        {
          local(first_row + row) =
            point.coordinates[used[i]->coordinate] + used[i]->reference - point.factor * used[i]->prescribed(point.time);
          local(12 + i) += lambda[row++];
        }
    if (is_screw)
      {
        local(first_row + row) =
          point.coordinates[used[0]->coordinate] - pitch * point.coordinates[used[1]->coordinate];
        local(12) += lambda[row];
        local(13) -= pitch * lambda[row];
        ++row;
      }
    for (const auto &s : no_slip)
      s.velocity.add_coefficients(pair, lambda[row++], local.template head<12>());
    for (unsigned int i = 0; i < stops.size(); ++i)
      local(12 + stops[i].motion) += touches(point, i) * stress[used.size() + i];
    block.add(local, r);
  }



  void
  Joint::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    const PairValues<double> pair(frame_a, frame_b, point.q);
    Eigen::MatrixXd          local     = Eigen::MatrixXd::Zero(block.size(), block.size());
    const double            *lambda    = point.multipliers + first_multiplier;
    const unsigned int       first_row = 12 + used.size();
    unsigned int             row       = 0;
    auto                     H         = local.topLeftCorner(12, 12);

    for (const auto &l : locked)
      {
        l.function.add_second_derivative(pair, lambda[row], H);
        l.function.add_gradient(pair, 1., local.col(first_row + row++).head<12>());
      }
    for (unsigned int i = 0; i < used.size(); ++i, ++row)
      {
        const FreeMotion &m     = *used[i];
        const double      value = point.coordinates[m.coordinate];
        auto              G     = local.col(first_row + row).head<12>();
        local(12 + i, 12 + i) += m.spring;
        if (m.is_angle())
          {
            const double s = std::sin(value), c = std::cos(value), l = lambda[row];
            m.first.add_second_derivative(pair, l * s, H);
            m.second.add_second_derivative(pair, -l * c * m.sign, H);
            m.first.add_gradient(pair, s, G);
            m.second.add_gradient(pair, -c * m.sign, G);
            Eigen::VectorXd mixed = Eigen::VectorXd::Zero(12);
            m.first.add_gradient(pair, l * c, mixed.head<12>());
            m.second.add_gradient(pair, l * s * m.sign, mixed.head<12>());
            local.col(12 + i).head<12>() += mixed;
            local.row(12 + i).head<12>() += mixed;
            local(12 + i, 12 + i) -= l * measure(m, pair, value);
            local(12 + i, first_row + row) = c * m.first.value(pair) + s * m.sign * m.second.value(pair);
          }
        else
          {
            m.first.add_second_derivative(pair, m.scale() * lambda[row], H);
            m.first.add_gradient(pair, m.scale(), G);
            local(12 + i, first_row + row) = -m.lever(value);
            if (m.is_length())
              local(12 + i, 12 + i) -= lambda[row] / m.reference;
          }
      }
    for (unsigned int i = 0; i < used.size(); ++i)
      if (used[i]->is_prescribed)
        local(12 + i, first_row + row++) = 1;
    if (is_screw)
      {
        local(12, first_row + row) = 1;
        local(13, first_row + row) = -pitch;
        ++row;
      }
    for (const auto &s : no_slip)
      {
        s.velocity.add_derivative(pair, lambda[row], H);
        s.velocity.add_coefficients(pair, 1., local.col(first_row + row++).head<12>());
      }
    for (unsigned int i = 0; i < stops.size(); ++i)
      {
        const unsigned int k = 12 + stops[i].motion;
        local(k, k) += touches(point, i) * used[stops[i].motion]->stop_stiffness;
      }
    local.bottomLeftCorner(rows.size(), first_row) = local.topRightCorner(first_row, rows.size()).transpose();
    block.add(local, K);
  }



  void
  Joint::damping(const Point<double> &point, SparseMatrix &C) const
  {
    Eigen::MatrixXd local = Eigen::MatrixXd::Zero(block.size(), block.size());
    for (unsigned int i = 0; i < used.size(); ++i)
      local(12 + i, 12 + i) = used[i]->damper;
    for (unsigned int i = 0; i < stops.size(); ++i)
      {
        const unsigned int k = 12 + stops[i].motion;
        local(k, k) += touches(point, i) * used[stops[i].motion]->stop_damping;
      }
    block.add(local, C);
  }



  void
  Joint::constraint_rates(const Point<double> &point, double *rates) const
  {
    const PairValues<double>     pair(frame_a, frame_b, point.q);
    Eigen::Matrix<double, 12, 1> y, gradient;
    y << frame_a.twist(point.y), frame_b.twist(point.y);
    unsigned int row = first_multiplier;
    for (const auto &l : locked)
      {
        gradient.setZero();
        l.function.add_gradient(pair, 1., gradient.head<12>());
        rates[row++] = gradient.dot(y);
      }
    for (const auto *m : used)
      {
        const double value = point.coordinates[m->coordinate], rate = point.rates[m->coordinate];
        gradient.setZero();
        if (m->is_angle())
          {
            const double s = std::sin(value), c = std::cos(value);
            m->first.add_gradient(pair, s, gradient.head<12>());
            m->second.add_gradient(pair, -c * m->sign, gradient.head<12>());
            rates[row++] = gradient.dot(y) + rate * (c * m->first.value(pair) + s * m->sign * m->second.value(pair));
          }
        else
          {
            m->first.add_gradient(pair, m->scale(), gradient.head<12>());
            rates[row++] = gradient.dot(y) - m->lever(value) * rate;
          }
      }
    for (const auto *m : used)
      if (m->is_prescribed)
        rates[row++] = point.rates[m->coordinate] - point.factor * m->prescribed.derivative(point.time);
    if (is_screw)
      rates[row++] = point.rates[used[0]->coordinate] - pitch * point.rates[used[1]->coordinate];
    for (const auto &s : no_slip)
      {
        gradient.setZero();
        s.velocity.add_coefficients(pair, 1., gradient.head<12>());
        rates[row++] = gradient.dot(y);
      }
  }



  void
  Joint::constraint_time_rates(const Point<double> &point, double *rates) const
  {
    unsigned int row = first_multiplier + locked.size() + used.size();
    for (const auto *m : used)
      if (m->is_prescribed)
        rates[row++] = -point.factor * m->prescribed.derivative(point.time);
  }



  bool
  Joint::has_loads() const
  {
    return std::any_of(used.begin(), used.end(), [](const FreeMotion *m) { return !m->force.is_zero(); });
  }



  bool
  Joint::has_damping() const
  {
    return std::any_of(used.begin(), used.end(), [](const FreeMotion *m) {
      return m->damper != 0 || ((m->has_lower_stop || m->has_upper_stop) && m->stop_damping != 0);
    });
  }



  double
  Joint::angle_or_gap(const FreeMotion &motion, const State &state) const
  {
    if (motion.coordinate >= 0)
      return state.coordinates[motion.coordinate] + motion.reference;
    const PairValues<double> pair(frame_a, frame_b, state.q.data());
    if (motion.is_length())
      return std::sqrt(motion.first.value(pair));
    if (!motion.is_angle())
      return motion.first.value(pair);
    return std::atan2(motion.sign * motion.second.value(pair), motion.first.value(pair));
  }



  std::optional<Probe>
  Joint::probe(const std::string &path) const
  {
    for (const auto &motion : free)
      if (path == motion.name)
        return Probe{path, motion.is_angle() ? "deg" : "m", [&](const State &state) {
                       return angle_or_gap(motion, state) * (motion.is_angle() ? 180. / M_PI : 1.);
                     }};
      else if (path == motion.name + " rate" && motion.coordinate >= 0)
        return Probe{path, motion.is_angle() ? "rad/s" : "m/s", [&](const State &state) {
                       return state.rates[motion.coordinate];
                     }};
    for (const bool is_moment : {false, true})
      for (unsigned int i = 0; i < 3; ++i)
        if (path == (is_moment ? "moment " : "force ") + std::to_string(i + 1))
          if (const auto value = action(is_moment, i))
            return Probe{path, is_moment ? "N m" : "N", value};
    return {};
  }



  std::function<double(const State &)>
  Joint::action(const bool is_moment, const unsigned int axis) const
  {
    if (rows.empty())
      return nullptr;
    for (unsigned int i = 0; i < used.size(); ++i)
      if (used[i]->is_angle() == is_moment && used[i]->axis == axis)
        return [this, i](const State &state) {
          const double lambda = state.multipliers[first_multiplier + locked.size() + i];
          return used[i]->is_angle() ? lambda : -lambda;
        };
    for (unsigned int i = 0; i < no_slip.size(); ++i)
      if (!is_moment && no_slip[i].axis == axis)
        return [this, k = first_multiplier + rows.size() - no_slip.size() + i](const State &state) {
          return -state.multipliers[k];
        };
    const auto is_rotation = [](const Locked &l) { return l.function.kind == PairFunction::cosine; };
    for (unsigned int i = 0; i < locked.size(); ++i)
      if (locked[i].axis == axis && locked[i].function.kind == (is_moment ? PairFunction::cosine : PairFunction::gap))
        {
          if (!is_moment || std::count_if(locked.begin(), locked.end(), is_rotation) == 1)
            return [this, i](const State &state) { return locked[i].sign * state.multipliers[first_multiplier + i]; };
          // all moments of locked rotations together, seen in the axes of A
          return [this, axis, is_rotation](const State &state) {
            const Matrix3 A = frame_a.triad(state.q.data()), B = frame_b.triad(state.q.data());
            Vector3       moment = Vector3::Zero();
            for (unsigned int k = 0; k < locked.size(); ++k)
              if (is_rotation(locked[k]))
                moment += state.multipliers[first_multiplier + k] *
                          A.col(locked[k].function.i).cross(B.col(locked[k].function.j));
            return A.col(axis).dot(moment);
          };
        }
    return nullptr;
  }



  std::vector<std::string>
  Joint::probe_names() const
  {
    std::vector<std::string> names;
    for (const auto &motion : free)
      names.push_back(motion.name);
    for (const bool is_moment : {false, true})
      for (unsigned int i = 0; i < 3; ++i)
        if (action(is_moment, i))
          names.push_back((is_moment ? "moment " : "force ") + std::to_string(i + 1));
    return names;
  }



  void
  Joint::draw(const State &state, Drawing &drawing) const
  {
    Sample a, b;
    a.x = frame_a.position(state.q.data());
    a.D = frame_a.triad(state.q.data());
    b.x = frame_b.position(state.q.data());
    b.D = frame_b.triad(state.q.data());
    drawing.begin_object(name);
    // a short cylinder along axis 3 with a thinner one of body B through it
    drawing.cylinder(a, 2, 0.5 * draw_size, draw_size);
    drawing.cylinder(b, 2, 0.25 * draw_size, 1.6 * draw_size);
  }



  template class Evaluated<Joint>;
} // namespace samara

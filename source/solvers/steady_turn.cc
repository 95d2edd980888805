// How the rates of a motion that is not steady change while a drive turns once.

#include <samara/base/text.h>
#include <samara/solvers/joint_motion.h>
#include <samara/solvers/newton.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Let a node go on with this twist, constant in its own axes, for the time @p t: the screw motion exp of the twist. */
    void
    move_node(State &state, const unsigned int node, const Vector6 &twist, const double t)
    {
      const Vector3       r     = t * twist.tail<3>();
      const double        angle = r.norm();
      const Matrix3       s     = skew(r);
      Eigen::Map<Vector3> x(&state.q[12 * node]);
      Eigen::Map<Matrix3> D(&state.q[12 * node + 3]);
      // exponential of a screw motion; below the limit the quotients have lost more digits than their limits lack
      const double        a = angle > 1e-4 ? (1 - std::cos(angle)) / (angle * angle) : 0.5,
                   b        = angle > 1e-4 ? (angle - std::sin(angle)) / std::pow(angle, 3) : 1. / 6;
      x += D * (Matrix3::Identity() + a * s + b * s * s) * (t * twist.head<3>());
      D = (D * rotation_of_vector(r)).eval();
    }



    /** Let all nodes and coordinates go on with these velocities, constant in the nodes' axes, for the time @p t. */
    State
    moved(const System &system, const State &from, const std::vector<double> &y, const double t)
    {
      State state = from;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        move_node(state, node, Eigen::Map<const Vector6>(&y[system.layout.of_node(node)]), t);
      for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
        state.coordinates[i] += t * y[system.layout.of_coordinate(i)];
      return state;
    }
  } // namespace



  State
  moved_on(const System &system, const State &from, const double t)
  {
    State state = from;
    for (unsigned int node = 0; node < system.layout.n_nodes; ++node)
      move_node(state, node, Eigen::Map<const Vector6>(&from.y[6 * node]), t);
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      state.coordinates[i] += t * from.rates[i];
    return state;
  }



  std::vector<RateRange>
  rates_of_one_turn(const System &system, const State &start, const std::vector<double> &speeds)
  {
    double speed = 0;
    for (unsigned int i = 0; i < speeds.size(); ++i)
      if (system.model.rotations[i].coordinate >= 0)
        speed = std::max(speed, std::abs(speeds[i]));
    std::vector<RateRange> ranges;
    const unsigned int     n_steps = 24;
    const double           h       = speed > 0 ? 2 * M_PI / n_steps / speed : 0.;
    State                  state   = start;
    for (unsigned int step = 0; step < n_steps && speed > 0; ++step)
      {
        const JointMotion one(system, state, speeds);
        for (unsigned int i = 0; i < one.rates.size(); ++i)
          {
            const double value = one.value_of(one.rates[i]);
            if (step == 0)
              ranges.push_back({one.rates[i].name, value, value});
            ranges[i].lowest  = std::min(ranges[i].lowest, value);
            ranges[i].highest = std::max(ranges[i].highest, value);
          }
        const std::vector<double> &k1 = one.velocities,
                                  k2  = JointMotion(system, moved(system, state, k1, h / 2), speeds).velocities,
                                  k3  = JointMotion(system, moved(system, state, k2, h / 2), speeds).velocities,
                                  k4  = JointMotion(system, moved(system, state, k3, h), speeds).velocities;
        std::vector<double> y(k1.size());
        for (unsigned int i = 0; i < y.size(); ++i)
          y[i] = (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]) / 6;
        state = moved(system, state, y, h);
      }
    return ranges;
  }



  std::string
  why_not_steady(const System              &system,
                 const State               &state,
                 const std::vector<double> &speeds,
                 const SteadyMotion        &motion)
  {
    if (motion.is_steady())
      return "";
    if (!motion.strained.empty())
      return "<" + motion.strained + "> is strained as parts turn, by " + number_to_text("%.2g", motion.strain) +
             " of its scale: bearings are out of line, or what turns is bent";
    std::vector<RateRange> ranges;
    try
      {
        ranges = rates_of_one_turn(system, state, speeds);
      }
    catch (const InputError &)
      {
        return "parts lock on the way round";
      }
    // those that vary most first, relative to what they are
    std::sort(ranges.begin(), ranges.end(), [](const RateRange &a, const RateRange &b) {
      return a.highest - a.lowest > b.highest - b.lowest;
    });
    double speed = 0;
    for (const double s : speeds)
      speed = std::max(speed, std::abs(s));
    std::string text;
    for (unsigned int i = 0; i < std::min<std::size_t>(3, ranges.size()); ++i)
      if (ranges[i].highest - ranges[i].lowest > 1e-5 * speed * model_length(system.model))
        text += (text.empty() ? "in one turn " : ", ") + ("<" + ranges[i].name + ">") + " goes from " +
                number_to_text("%.4g", ranges[i].lowest) + " to " + number_to_text("%.4g", ranges[i].highest);
    if (!text.empty())
      return text + " (rad/s or m/s)";
    text = "rates are constant, but parts turn about axes that move:";
    for (unsigned int i = 0; i < std::min<std::size_t>(3, motion.moving.size()); ++i)
      text += (i > 0 ? ", <" : " <") + motion.moving[i] + ">";
    return text + ": steady only if what turns there is axisymmetric";
  }
} // namespace samara

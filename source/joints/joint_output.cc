// Probes and drawing of joints.

#include <samara/joints/joint.h>
#include <samara/model/drawing.h>
#include <samara/model/probe_needs.h>

#include <algorithm>
#include <cmath>

namespace samara
{
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
    return motion.angle(pair);
  }



  std::optional<Probe>
  Joint::probe(const std::string &path) const
  {
    for (const auto &motion : free)
      if (path == motion.name)
        return Probe{path, motion.is_angle() ? "deg" : "m", OfPlaces{[&](const State &state) {
                       return angle_or_gap(motion, state) * (motion.is_angle() ? 180. / M_PI : 1.);
                     }}};
      else if (path == motion.name + " rate" && motion.coordinate >= 0)
        return Probe{path,
                     motion.is_angle() ? "rad/s" : "m/s",
                     OfVelocities{{[&](const State &state) { return state.rates[motion.coordinate]; }}}};
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
        return [k = first_multiplier + rows.size() - no_slip.size() + i](const State &state) {
          return -state.multipliers[k];
        };
    const auto is_rotation = [](const Locked &l) { return l.function.kind == PairFunction::cosine; };
    for (unsigned int i = 0; i < locked.size(); ++i)
      if ((locked[i].axis == axis || locked[i].less) &&
          locked[i].function.kind == (is_moment ? PairFunction::cosine : PairFunction::gap))
        {
          if (is_row_on_b(locked[i]))
            return [this, axis](const State &state) {
              // they are in the axes of B
              const Matrix3 A = frame_a.triad(state.q.data()), B = frame_b.triad(state.q.data());
              double        force = 0;
              for (unsigned int k = 0; k < locked.size(); ++k)
                if (is_row_on_b(locked[k]))
                  force += locked[k].sign * state.multipliers[first_multiplier + k] *
                           A.col(axis).dot(B.col(locked[k].function.i));
              return force;
            };
          if (!is_moment || (!locked[i].less && std::count_if(locked.begin(), locked.end(), is_rotation) == 1))
            return [this, i](const State &state) { return locked[i].sign * state.multipliers[first_multiplier + i]; };
          // all moments of locked rotations together, seen in the axes of A
          return [this, axis, is_rotation](const State &state) {
            const Matrix3 A = frame_a.triad(state.q.data()), B = frame_b.triad(state.q.data());
            Vector3       moment = Vector3::Zero();
            const auto    add    = [&](const PairFunction &f, const double factor) {
              moment += factor * A.col(f.i).cross(B.col(f.j));
            };
            for (unsigned int k = 0; k < locked.size(); ++k)
              if (is_rotation(locked[k]))
                {
                  const double lambda = state.multipliers[first_multiplier + k];
                  add(locked[k].function, lambda);
                  if (locked[k].less)
                    add(*locked[k].less, -lambda);
                }
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
    drawing.begin_object(name);
    draw_arms(state, drawing);
    const Sample       a = drawing.sample(frame_a, state), b = drawing.sample(frame_b, state);
    const unsigned int first = drawing.samples.size();
    if (kind == "spherical")
      {
        drawing.sphere(a, 0.5 * draw_size);
        drawing.cylinder(b, 2, 0.2 * draw_size, 1.6 * draw_size);
      }
    else if (kind == "universal") // axis 1 of A and axis 2 of B are the cross
      {
        drawing.cylinder(a, 0, 0.2 * draw_size, 1.6 * draw_size);
        drawing.cylinder(b, 1, 0.2 * draw_size, 1.6 * draw_size);
      }
    else if (kind == "rigid")
      drawing.box(a, Vector3::Constant(0.7 * draw_size));
    else if (kind == "prismatic")
      {
        drawing.box(a, draw_size * Vector3(0.9, 0.9, 1.));
        drawing.box(b, draw_size * Vector3(0.45, 0.45, 1.8));
      }
    else if (kind == "planar" || kind == "in plane")
      {
        drawing.box(a, draw_size * Vector3(1.6, 1.6, 0.1));
        drawing.sphere(b, 0.3 * draw_size);
      }
    else // a short cylinder along axis 3 with a thinner one of body B through it
      {
        drawing.cylinder(a, 2, 0.5 * draw_size, draw_size);
        drawing.cylinder(b, 2, 0.25 * draw_size, 1.6 * draw_size);
      }
    draw_reaction(state, a, first, drawing);
  }



  void
  Joint::draw_arms(const State &state, Drawing &drawing) const
  {
    for (const Frame *const frame : {&frame_a, &frame_b})
      {
        drawing.attach(*frame, state);
        Frame node;
        node.node = frame->node;
        // node 0 is the ground, whose origin is no part of the mechanism; frames of a weld are one
        const bool is_drawn = frame == &frame_b && frame_a.node == frame_b.node && frame_a.arm == frame_b.arm;
        if (frame->node > 0 && frame->arm.norm() > draw_size && !is_drawn)
          drawing.bar(drawing.sample(node, state), drawing.sample(*frame, state), 0.1 * draw_size);
      }
  }



  void
  Joint::draw_reaction(const State &state, const Sample &a, const unsigned int first, Drawing &drawing) const
  {
    if (!drawing.has_fields())
      return;
    for (const bool is_moment : {false, true})
      {
        Vector3 reaction = Vector3::Zero();
        bool    is_known = false;
        for (unsigned int axis = 0; axis < 3; ++axis)
          if (const auto component = action(is_moment, axis))
            {
              reaction += component(state) * a.D.col(axis);
              is_known = true;
            }
        if (!is_known)
          continue;
        Field &field = drawing.field(is_moment ? "joint moment" : "joint force", is_moment ? "N m" : "N", inertial_axes);
        for (unsigned int i = first; i < drawing.samples.size(); ++i)
          field.set(i, reaction);
      }
  }
} // namespace samara

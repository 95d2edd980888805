/*
 * Problem:   an aircraft that is held at an attitude which controls give, until nothing holds it
 * Reference: equilibrium of forces and moments in closed form
 */

#include <samara/analysis/dynamic.h>
#include <samara/analysis/trim.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  // a thrust along its axis, a side force behind, moments of a rotor; it carries a mass on a damped spring that is
  // shaken
  const std::string craft = R"(
set Analyses = trim
subsection Constants
  set weight = 45 kN
  set drag   = 5 kN
  set torque = 20 kN*m
end
subsection States
  subsection pitch
    set Type  = control
    set Unit  = rad
    set Scale = 1 deg
  end
  subsection roll
    set Copy of = pitch
  end
  subsection thrust
    set Type  = control
    set Unit  = N
    set Scale = 1 kN
    set Value = 40 kN
  end
  subsection side
    set Copy of = thrust
    set Value   = 0 N
  end
  subsection rolling
    set Type  = control
    set Unit  = N*m
    set Scale = 1 kN*m
  end
  subsection pitching
    set Copy of = rolling
  end
end
subsection Bodies
  subsection craft
    set Type     = rigid body
    set Mass     = weight/(10 m/s^2) - 100 kg
    set Inertia  = (1e4, 3e4, 3e4) kg*m^2
    set Position = 0, 0, -2 m
    set Frames   = hub at 0 0 0, tail at 9 0 -0.5
  end
  subsection cargo
    set Type     = rigid body
    set Mass     = 100 kg
    set Inertia  = (1, 1, 1) kg*m^2
    set Position = 0, 0, -2 m
  end
end
subsection Joints
  subsection hold
    set Type        = universal
    set Body A      = ground
    set Body B      = craft
    set Position    = 0, 0, 0
    set Axis        = 0, 1, 0
    set Second axis = 1, 0, 0
    subsection rotation 1
      set Prescribed = pitch
    end
    subsection rotation 2
      set Prescribed = roll
    end
  end
  subsection mount
    set Type   = prismatic
    set Body A = craft
    set Body B = cargo
    set Axis   = 0, 0, 1
    subsection displacement
      set Spring = 20 kN/m
      set Damper = 2 kN*s/m
      set Force  = 100 N*sin(20 rad/s*t)
    end
  end
end
subsection Loads
  subsection weight
    set Type         = gravity
    set Acceleration = 0, 0, -10 m/s^2
  end
  subsection drag
    set Type  = point load
    set At    = craft.hub
    set Force = drag, 0, 0
  end
  subsection rotor
    set Type   = point load
    set At     = craft.hub
    set Axes   = body
    set Force  = 0, 0, thrust
    set Moment = rolling, pitching, -torque
  end
  subsection tail
    set Type  = point load
    set At    = craft.tail
    set Axes  = body
    set Force = 0, side, 0
  end
end
subsection Trim
  set Controls  = pitch from -30 deg to 30 deg, roll from -30 deg to 30 deg, thrust, side, rolling, pitching
  set Targets   = hold.force 1 = 0 N, hold.force 2 = 0 N, hold.force 3 = 0 N, hold.moment 1 = 0 N*m, \
                  hold.moment 2 = 0 N*m, hold.moment 3 = 0 N*m
  set Scales    = weight, weight, weight, torque, torque, torque
  set Period    = 2*pi/(20 rad/s)
  set Steps     = 12
  set Tolerance = 1e-9
end
)";
} // namespace



// Pitch and roll turn the held body; what they and the forces must be is a triangle of forces.
TEST(FreeFlight, AttitudesInClosedForm)
{
  const double W = 45e3, D = 5e3, Q = 20e3;
  const double side = Q / 9, across = std::hypot(W, D), roll = std::asin(side / across);
  for (const std::string method : {"Newton-Krylov", "discrete", "auto-pilot"})
    {
      SCOPED_TRACE(method);
      Scene scene(craft, {"Trim/Method = " + method});
      auto &trim = scene.analysis<TrimAnalysis>();
      trim.run(scene.context);
      const auto &u = trim.report.controls;
      EXPECT_NEAR(u[0], -std::atan(D / W), 1e-7);
      EXPECT_NEAR(u[1], roll, 1e-7);
      EXPECT_NEAR(u[2], across * std::cos(roll), 1e-3);
      EXPECT_NEAR(u[3], side, 1e-3);
      // the side force is half a metre below the hub, the weight two metres, and the cargo as much more as its spring
      // gives
      const double sag = 1e3 * std::cos(roll) * std::cos(u[0]) / 20e3;
      EXPECT_NEAR(u[4], -0.5 * side + (2 * W + 1e3 * sag) * std::sin(roll) * std::cos(u[0]), 1e-2);
      EXPECT_NEAR(u[5], (2 * W + 1e3 * sag) * std::sin(u[0]), 1e-2);
    }
}



// What the air does to the blades, the drag, the tail rotor and the weights balance each other, all six.
TEST(FreeFlight, HelicopterInEquilibrium)
{
  const unsigned int n = 24;
  Scene              scene("prm/rotorcraft/puma_free_flight.prm",
              {"Analyses = trim, dynamic",
                            "Aerodynamics/flow/Type = uniform inflow",
                            "Subsystems/blade/Surfaces/blade/Stations = 1",
                            "Trim/Method = discrete",
                            "Trim/Steps = " + std::to_string(n),
                            "Trim/Stages = 2",
                            "Trim/Settle = 2",
                            "Trim/Tolerance = 1e-5",
                            "Dynamic/Step = 2*pi/(28 rad/s)/" + std::to_string(n),
                            "Dynamic/End time = 2*pi/(28 rad/s)"});
  auto              &trim = scene.analysis<TrimAnalysis>();
  trim.run(scene.context);

  std::array<std::vector<Probe>, 3> forces, moments, places;
  const std::string                 axes = "xyz";
  const auto                        find = [&](const std::string &path) { return scene.input.model.probe(path); };
  for (unsigned int i = 0; i < 3; ++i)
    {
      const std::string axis(1, axes[i]);
      for (const std::string k : {"1", "2", "3", "4"})
        {
          forces[i].push_back(find("blade " + k + ":blade.force " + axis));
          moments[i].push_back(find("blade " + k + ":blade.moment " + axis));
          places[i].push_back(find("blade " + k + ":rod.centre.position " + axis));
        }
      places[i].push_back(find("fuselage.centre.position " + axis));
      places[i].push_back(find("fuselage.tail rotor.position " + axis));
    }
  const double R = 7.49, rho = 1.05, speed = 28 * R, weight = 0.0695 * 4 * 0.537 * R * rho * speed * speed;
  const double fuselage = weight - 520.404 * 9.81, q = 0.5 * rho * std::pow(0.321 * speed, 2);
  Vector3      force = Vector3::Zero(), moment = Vector3::Zero();
  const auto   at = [](const auto &probes, const unsigned int k, const State &s) {
    return Vector3(probes[0][k].value(s), probes[1][k].value(s), probes[2][k].value(s));
  };
  unsigned int count  = 0;
  auto        &motion = scene.analysis<DynamicAnalysis>();
  motion.observer     = [&](const State &state) {
    if (count++ == 0)
      return;
    const double  pitch = trim.report.controls[3], roll = trim.report.controls[4], tail = trim.report.controls[5];
    const Vector3 side(std::sin(pitch) * std::sin(roll), std::cos(roll), std::cos(pitch) * std::sin(roll));
    const auto    add = [&](const Vector3 &f, const Vector3 &place) {
      force += f / n;
      moment += place.cross(f) / n;
    };
    for (unsigned int k = 0; k < 4; ++k)
      {
        force += at(forces, k, state) / n;
        moment += at(moments, k, state) / n;
        add(Vector3(0, 0, -91.6 * 9.81), at(places, k, state));
      }
    // hub, links and bearings
    add(Vector3(0, 0, -(520.404 - 4 * 91.6) * 9.81), Vector3::Zero());
    add(Vector3(2 * q, 0, -fuselage), at(places, 4, state));
    add(tail * side, at(places, 5, state));
  };
  motion.run(scene.context);
  ASSERT_EQ(count, n + 1);
  for (unsigned int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(force(i), 0, 2e-4 * weight) << i;
      EXPECT_NEAR(moment(i), 0, 2e-4 * weight * R) << i;
    }
  // the disk is tilted forward as drag and weight ask for
  EXPECT_NEAR(trim.report.controls[3], -std::atan(2 * q / weight), 0.02);
}

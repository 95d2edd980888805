#ifndef samara_tests_time_systems_h
#define samara_tests_time_systems_h

// The systems of which the statements about the integrator family are tested.

#include <samara/time/projection.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <functional>

#include "measured.h"

namespace samara
{
  /** A model, how it starts, and what may be expected of it. */
  struct MovingSystem
  {
    std::string name, text;
    double      h;               ///< a step in which it turns by some tenth of a radian
    double      T;               ///< over which orders show; zero: so stiff that they do not
    bool        is_free = false; ///< nothing outside acts on it: its momenta are constant

    /** Added to the velocities the text gives at the start; then they are made to obey the constraints. */
    std::function<void(const System &, State &)> kick = nullptr;
  };



  /** In the reference configuration, with the velocities that the system has there. */
  inline State
  start_of(const MovingSystem &what, const System &system)
  {
    State state = system.reference();
    system.add_initial_velocities(state);
    if (what.kick)
      what.kick(system, state);
    Projection(system).velocities(state);
    return state;
  }



  namespace systems
  {
    inline std::string
    rigid_body(const std::string &name, const std::string &entries)
    {
      return "  subsection " + name + "\n set Type = rigid body\n" + entries + " end\n";
    }

    inline std::string
    joint(const std::string &name, const std::string &kind, const std::string &entries)
    {
      return "  subsection " + name + "\n set Type = " + kind + "\n" + entries + " end\n";
    }

    inline std::string
    motion(const std::string &name, const std::string &entries)
    {
      return " subsection " + name + "\n" + entries + " end\n";
    }

    inline std::string
    spring(const std::string &k, const std::string &c, const std::string &rest = "0")
    {
      return " set Spring = " + k + "\n set Damper = " + c + "\n set Rest = " + rest + "\n";
    }

    inline std::string
    model(const std::string &bodies, const std::string &joints, const std::string &loads = "")
    {
      return "subsection Bodies\n" + bodies + "end\nsubsection Joints\n" + joints + "end\nsubsection Loads\n" + loads +
             "end\n";
    }

    inline std::string
    moving(const std::string &velocity, const std::string &spin)
    {
      return " set Velocity = " + velocity + "\n set Angular velocity = " + spin + "\n";
    }

    const std::string gravity = "  subsection weight\n set Type = gravity\n end\n";

    // Two bodies without any symmetry, from x = 0 to 1 and on to 2.
    const std::string offset  = "set Mass = 2\n set Position = 0.5, 0, 0\n set Centre of mass = 0.1, 0.05, -0.1\n"
                                " set Inertia = 0.1, 0.2, 0.25, 0.01, 0.02, -0.01\n"
                                " set Frames = pivot at 0 0 0, hinge at 1 0 0\n",
                      second  = "set Mass = 1\n set Position = 1.5, 0, 0\n set Centre of mass = 0, 0.1, 0.1\n"
                                " set Inertia = 0.1, 0.12, 0.15\n",
                      slanted = " set Axis = 0, 1, 1\n", turn = motion("rotation", spring("3", "0.2", "0.4")),
                      slide  = motion("displacement", spring("20", "0.5", "0.1")),
                      thrown = rigid_body("a", offset + moving("0.3, -0.5, 1", "1, 2, -1.5")) +
                               rigid_body("b", second + moving("0.8, 0, -0.4", "-1, -1, 3"));

    /** The two in flight with a joint between them that is at neither's node. */
    inline MovingSystem
    pair(const std::string &kind, const std::string &entries, const std::string &more = "", const double h = 0.05)
    {
      const std::string ends = "set Body A = a.hinge\n set Body B = b.centre\n";
      return {kind + " joint in flight", model(thrown, joint("j", kind, ends + entries) + more), h, 0.2, true};
    }

    /** The two hanging from the ground, hinged to each other. */
    inline MovingSystem
    hanging(const std::string &name, const std::string &kind, const std::string &entries, const std::string &hinge)
    {
      return {name,
              model(rigid_body("a", offset + moving("0, 0, 0", "1.5, 2, -1")) +
                      rigid_body("b", second + moving("0.5, -1.5, -2", "0, 3, 1")),
                    joint("ground", kind, "set Body A = ground\n set Body B = a.pivot\n" + entries) +
                      joint("hinge",
                            "revolute",
                            "set Body A = a.hinge\n set Body B = b.centre\n set Position = 1, 0, 0\n" + slanted +
                              hinge),
                    gravity),
              0.03,
              0.2};
    }

    /** Along x, with an offset mass; all its stiffnesses against stretching EA, against bending EI. */
    inline std::string
    beam(const std::string &EA,
         const std::string &EI,
         const std::string &entries,
         const std::string &mesh = " set Elements = 2\n set Degree = 2\n")
    {
      return "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = " + EA +
             "\n set GA2 = " + EA + "\n set GA3 = " + EA + "\n set GJ = " + EI + "\n set EI2 = " + EI +
             "\n set EI3 = " + EI +
             "\n set Mass = 1\n set I2 = 0.02\n set I3 = 0.03\n set Mass centre = 0.02, -0.03\n end\nend\n"
             "subsection Bodies\n  subsection rod\n set Type = beam\n set Section = s\n" +
             mesh + entries + " end\nend\n";
    }

    /** Velocities and spins that vary along x: strains have rates, shear and stretching too. */
    inline void
    bend(const System &system, State &state)
    {
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        {
          const double x = system.model.nodes[node].x(0) - 1;
          Vector6      y;
          y << 0, 0, 1.5 * x * x, 0.5 * x, -3 * x, x;
          Eigen::Map<Vector6>(&state.y[6 * node]) += y;
        }
    }

    inline MovingSystem
    flying_beam(const std::string &EA, const std::string &EI, const double h, const double T)
    {
      const std::string entries = "set Points = 0, 0, 0; 2, 0, 0\n" + moving("0.3, -0.5, 1", "0.2, -0.5, 3");
      return {"flying beam, EA = " + EA, beam(EA, EI, entries), h, T, true, bend};
    }

    /** The same with tension that stiffens torsion: a strain that is no quadratic function of places and triads. */
    inline MovingSystem
    flying_blade()
    {
      MovingSystem what = flying_beam("30", "2", 0.02, 0.05);
      what.name         = "flying beam with trapeze effect";
      what.text.insert(what.text.find(" set Mass = 1"),
                       " set Tension centre = 0.01, 0.02\n set Trapeze coupling = 8\n set Trapeze stiffness = 4\n");
      return what;
    }

    inline MovingSystem
    hinged_beam(const std::string &EA, const std::string &EI, const double h, const double T)
    {
      const std::string entries = "set Points = 0.3, 0, 0; 2, 0, 0\n" + moving("0, 1.2, 0", "0, 0, 4"),
                        hinge   = "set Body A = ground\n set Body B = rod.start\n set Position = 0, 0, 0\n";
      return {"hinged rotating beam, EA = " + EA,
              beam(EA, EI, entries) + "subsection Joints\n" + joint("hinge", "revolute", hinge) + "end\n",
              h,
              T};
    }

    /** Crank, connecting rod and slider in the plane y = 0; @p joints between crank and slider. */
    inline MovingSystem
    slider_crank(const std::string &name, const std::string &rod, const std::string &joints)
    {
      return {
        name,
        model(rigid_body("crank",
                         "set Mass = 1\n set Inertia = 0.02, 0.02, 0.03\n set Position = 0.15, 0, 0.2\n"
                         " set Frames = pin at 0 0 0, end at 0.3 0 0.4\n" +
                           moving("2.4, 0, -1.8", "0, 12, 0")) +
                rod + rigid_body("slider", "set Mass = 2\n set Inertia = 0.1, 0.1, 0.1\n set Position = 1.5, 0, 0\n"),
              joint("main", "revolute", "set Body A = ground\n set Body B = crank.pin\n set Axis = 0, 1, 0\n" + turn) +
                joints +
                joint("guide", "prismatic", "set Body A = ground\n set Body B = slider.centre\n set Axis = 1, 0, 0\n"),
              gravity),
        0.01,
        0.15};
    }

    inline MovingSystem
    rolling_ball()
    {
      return {"ball rolling on a driven table",
              model(rigid_body("table", "set Mass = 1\n set Inertia = 1, 1, 1\n set Position = 0, 0, 0\n") +
                      rigid_body("ball",
                                 "set Mass = 3\n set Inertia = 0.1, 0.1, 0.1\n set Position = 1, 0.5, 0.3\n" +
                                   moving("0.5, -0.7, 0", "1, 2, 3")),
                    joint("drive",
                          "revolute",
                          "set Body A = ground\n set Body B = table.centre\n set Axis = 0.1, 0.2, 1\n" +
                            motion("rotation", " set Prescribed = 2*t + 0.3*sin(2*t)\n")) +
                      joint("floor",
                            "rolling ball",
                            "set Body A = table.centre\n set Body B = ball.centre\n set Radius = 0.3\n"),
                    gravity),
              0.04,
              0.2};
    }

    inline MovingSystem
    sledge()
    {
      const std::string ends = "set Body A = ground\n set Body B = sledge.centre\n";
      return {"sledge on an inclined plane",
              model(rigid_body("sledge",
                               "set Mass = 3\n set Inertia = 1, 1, 0.5\n set Position = 0.2, 0, 0\n" +
                                 moving("1, 0.4, 0", "0, 0, 2")),
                    joint("ice", "planar", ends + " set Axis 1 = 1, 0, 0\n") +
                      joint("blade", "knife edge", ends + " set Position = 0, 0, 0\n set Axis = 0, 1, 0\n"),
                    "  subsection weight\n set Type = gravity\n set Acceleration = 3, 1, -9\n end\n"),
              0.05,
              0.3};
    }

    inline MovingSystem
    gears()
    {
      const std::string wheel = "set Mass = 1\n set Inertia = 0.1, 0.1, 0.2\n";
      return {
        "gears in flight",
        model(rigid_body("housing", offset + moving("0.3, -0.5, 1", "1, 2, -1.5")) +
                rigid_body("wheel", wheel + " set Position = 1, 0, 0\n" + moving("0.3, -0.5, 1", "2, 2, 0")) +
                rigid_body("pinion", wheel + " set Position = 0, 0, 0\n"),
              joint("A", "revolute", "set Body A = housing.hinge\n set Body B = wheel.centre\n set Axis = 1, 0, 0\n") +
                joint("B",
                      "revolute",
                      "set Body A = housing.pivot\n set Body B = pinion.centre\n set Axis = 0, 3, 4\n" + turn) +
                joint("gear", "gear", "set Joint A = A\n set Joint B = B\n set Ratio = -2.5\n")),
        0.02,
        0.2,
        true};
    }



    /** Bodies that slide along a flying beam of one element, one for each kind of slider: its name, kind and entries.
     */
    inline MovingSystem
    sliders(const std::string &name, const std::vector<std::array<std::string, 3>> &kinds, const bool is_free)
    {
      std::string  bodies, joints;
      unsigned int i = 0;
      for (const auto &[body, kind, entries] : kinds)
        {
          const std::string x = std::to_string(0.5 + 0.5 * i);
          bodies += rigid_body(body,
                               "set Mass = 0.4\n set Inertia = 0.02, 0.03, 0.035\n set Position = " + x +
                                 ", 0, 0\n set Centre of mass = 0.02, 0.03, -0.01\n" +
                                 moving(i == 1 ? "-1, 0, 0" : "1.5, 0, 0", "0.4, 0, 0"));
          joints += joint("on " + body, kind, "set Body A = rod\n set Body B = " + body + "\n" + entries);
          ++i;
        }
      const std::string rod  = "set Points = 0, 0, 0; 2, 0, 0\n" + moving("0.3, -0.5, 1", "0.2, -0.5, 1");
      std::string       text = beam("30", "2", rod, " set Elements = 1\n set Degree = 3\n");
      text.insert(text.rfind("end\n"), bodies); // of the subsection of bodies
      return {name, text + "subsection Joints\n" + joints + "end\n", 0.01, 0.05, is_free, bend};
    }



    /** 2 kg on a spring, ω = 5, and a force along z. */
    inline std::string
    pushed(const std::string &force)
    {
      return model(rigid_body("a", "set Mass = 2\n set Inertia = 1, 1, 1\n"),
                   joint("slide",
                         "prismatic",
                         "set Body A = ground\n set Body B = a.centre\n" + motion("displacement", spring("50", "0"))),
                   "  subsection push\n set Type = point load\n set At = a.centre\n set Force = 0, 0, " + force +
                     "\n end\n");
    }
  } // namespace systems



  /** All of them. */
  inline std::vector<MovingSystem>
  moving_systems()
  {
    using namespace systems;
    const std::string bush = "set Body A = a.hinge\n set Body B = b.centre\n set Rotational stiffness = 3, 2, 1\n"
                             " set Rotational damping = 0.1, 0.2, 0.3\n";
    return {
      {"offset body in flight",
       model(rigid_body("a", offset + moving("0.3, -0.5, 1", "1, 2, -1.5")), ""),
       0.1,
       0.4,
       true},
      {"heavy top",
       model(rigid_body("a", offset + moving("0, 0, 0", "8, 1, -1")),
             joint("tip", "spherical", "set Body A = ground\n set Body B = a.pivot\n"),
             gravity),
       0.01,
       0.2},
      hanging("two bodies", "spherical", "", turn),
      hanging("double pendulum", "spherical", "", ""),
      hanging("prescribed rotation", "revolute", motion("rotation", " set Prescribed = 0.8*sin(3*t) + t\n"), turn),
      slider_crank("crank and slider",
                   rigid_body("rod",
                              "set Mass = 0.5\n set Inertia = 0.01, 0.05, 0.06\n set Position = 0.9, 0, 0.2\n"
                              " set Frames = end at 0.3 0 0.4, head at 1.5 0 0\n"),
                   joint("knee", "spherical", "set Body A = crank.end\n set Body B = rod.end\n") +
                     joint("elbow",
                           "universal",
                           "set Body A = rod.head\n set Body B = slider.centre\n set Axis = 0, 1, 0\n"
                           " set Second axis = 0, 0, 1\n")),
      slider_crank("crank and slider with a massless rod",
                   "",
                   joint("rod", "distance", "set Body A = crank.end\n set Body B = slider.centre\n")),
      flying_beam("30", "2", 0.02, 0.05),
      hinged_beam("30", "2", 0.02, 0.05),
      hinged_beam("1e8", "100", 0.005, 0),
      pair("revolute", slanted + turn),
      pair("prismatic", slanted + slide),
      pair("screw", slanted + " set Pitch = 0.2\n" + turn + motion("displacement", spring("20", "0.5"))),
      pair("cylindrical", slanted + turn + slide),
      pair("planar",
           slanted + turn + motion("displacement 1", spring("20", "0.5")) +
             motion("displacement 2", spring("10", "0.3"))),
      pair("spherical", "", joint("bush", "flexible joint", bush)),
      pair("universal",
           " set Axis = 0, 1, 1\n set Second axis = 1, 0, 0\n" + motion("rotation 1", spring("3", "0.2")) +
             motion("rotation 2", spring("2", "0.1"))),
      pair("skew universal",
           " set Axis = 0, 1, 1\n set Second axis = 2, 1, 0\n" + motion("rotation 1", spring("3", "0.2")) +
             motion("rotation 2", spring("2", "0.1")),
           "",
           0.02),
      pair("constant velocity", " set Axis = 1, 0, 0\n set Second axis = 2, 1, 0\n"),
      pair("in line", slanted + slide),
      pair("in plane",
           slanted + motion("displacement 1", spring("20", "0.5")) + motion("displacement 2", spring("10", "0.3"))),
      {"body on springs in fixed axes",
       model(rigid_body("a", offset + moving("0.3, -0.5, 1", "1, 2, -1.5")),
             joint("mount",
                   "springs in fixed axes",
                   "set Body A = ground\n set Body B = a.hinge\n set Axis = 1, 2, 2\n set Stiffness = 20, 30, 10\n"
                   " set Damping = 0.1, 0.2, 0.3\n"),
             gravity),
       0.05,
       0.2},
      gears(),
      rolling_ball(),
      sledge(),
      sliders("sliders on a flying beam",
              {{{"a", "sliding point", motion("displacement", spring("3", "0.2", "0.1"))},
                {"b", "sliding screw", " set Turn per length = 3\n"},
                {"c", "sliding prismatic", motion("displacement", " set Prescribed = 0.4*sin(4*t)\n")}}},
              false),
    };
  }



  /** Call @p check with each of the systems, read and at its start. */
  template <typename Check>
  void
  for_all_systems(const Check &check)
  {
    for (const MovingSystem &what : moving_systems())
      {
        SCOPED_TRACE(what.name);
        const Scene scene(what.text);
        check(what, scene.system, start_of(what, scene.system));
      }
  }
} // namespace samara

#endif

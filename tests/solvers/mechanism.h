#ifndef samara_tests_mechanism_h
#define samara_tests_mechanism_h

#include <samara/solvers/joint_motion.h>

#include "../scene.h"

#include <map>

namespace samara
{
  using Point3 = std::array<double, 3>;

  /** The text of a model of rigid bodies, 1 kg each, and joints, put together by calls. */
  class Mechanism
  {
  public:
    /** Other points of a body are told in "Frames". */
    Mechanism &
    body(const std::string &name, const Point3 &x, const std::string &frames = "")
    {
      bodies += "  subsection " + name +
                "\n    set Type = rigid body\n    set Mass = 1\n    set Inertia = 0.1, 0.1, 0.1\n" +
                "    set Position = " + text(x) + "\n" + (frames.empty() ? "" : "    set Frames = " + frames + "\n") +
                "  end\n";
      return *this;
    }

    Mechanism &
    joint(const std::string &name,
          const std::string &kind,
          const std::string &a,
          const std::string &b,
          const std::string &more)
    {
      joints += "  subsection " + name + "\n    set Type = " + kind + "\n    set Body A = " + a +
                "\n    set Body B = " + b + "\n" + more + "  end\n";
      return *this;
    }

    Mechanism &
    revolute(const std::string &name,
             const std::string &a,
             const std::string &b,
             const Point3      &at,
             const Point3      &axis = {0, 0, 1})
    {
      return joint(name, "revolute", a, b, place(at) + "    set Axis = " + text(axis) + "\n");
    }

    Mechanism &
    universal(const std::string &name,
              const std::string &a,
              const std::string &b,
              const Point3      &at,
              const Point3      &axis,
              const Point3      &second,
              const bool         held = false)
    {
      return joint(name,
                   "universal",
                   a,
                   b,
                   place(at) + "    set Axis = " + text(axis) + "\n    set Second axis = " + text(second) + "\n" +
                     (held ? std::string(hold("rotation 1")) + hold("rotation 2") : ""));
    }

    Mechanism &
    elastic(const std::string &name, const std::string &a, const std::string &b, const Point3 &at)
    {
      return joint(name,
                   "flexible joint",
                   a,
                   b,
                   place(at) + "    set Stiffness = 1e6, 1e6, 1e6\n    set Rotational stiffness = 1e5, 1e5, 1e5\n");
    }

    Mechanism &
    gear(const std::string &name, const std::string &a, const std::string &b, const double ratio)
    {
      joints += "  subsection " + name + "\n    set Type = gear\n    set Joint A = " + a + "\n    set Joint B = " + b +
                "\n    set Ratio = " + number(ratio) + "\n  end\n";
      return *this;
    }

    Mechanism &
    drive(const std::string &joint, const double speed)
    {
      loads += "  subsection drive of " + joint + "\n    set Type = steady rotation\n    set Joint = " + joint +
               "\n    set Speed = " + number(speed) + "\n  end\n";
      return *this;
    }

    static std::string
    place(const Point3 &at)
    {
      return "    set Position = " + text(at) + "\n";
    }
    static std::string
    hold(const std::string &motion)
    {
      return "    subsection " + motion + "\n      set Prescribed = 0\n    end\n";
    }
    static std::string
    number(const double x)
    {
      char result[32];
      std::snprintf(result, sizeof result, "%.17g", x);
      return result;
    }
    static std::string
    text(const Point3 &x)
    {
      return number(x[0]) + ", " + number(x[1]) + ", " + number(x[2]);
    }

    std::string
    prm() const
    {
      return "set Analyses = static\nsubsection Bodies\n" + bodies + "end\nsubsection Joints\n" + joints +
             "end\nsubsection Loads\n" + loads + "end\n";
    }

  private:
    std::string bodies, joints, loads;
  };



  /** The motion of a mechanism in its reference configuration. */
  struct Moving
  {
    Scene                         scene;
    JointMotion                   motion;
    std::map<std::string, double> rates; ///< of joints; of several with one name the largest

    explicit Moving(const Mechanism &mechanism)
      : scene(mechanism.prm())
      , motion(scene.system, scene.context.state, scene.context.speeds)
    {
      set_steady_motion(scene.system, scene.context.state, scene.context.speeds);
      for (const auto &rate : motion.rates)
        if (const double value = motion.value_of(rate); std::abs(value) >= std::abs(rates[rate.name]))
          rates[rate.name] = value;
    }

    Vector3
    spin(const std::string &body) const
    {
      return {scene.value(body + ".angular velocity x"),
              scene.value(body + ".angular velocity y"),
              scene.value(body + ".angular velocity z")};
    }

    /** The lowest and highest rate in one turn. */
    RateRange
    range(const std::string &name) const
    {
      for (const auto &r : rates_of_one_turn(scene.system, scene.context.state, scene.context.speeds))
        if (r.name == name)
          return r;
      return {name, std::nan(""), std::nan("")};
    }
  };
} // namespace samara

#endif

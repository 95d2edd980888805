#ifndef samara_tests_drawings_h
#define samara_tests_drawings_h

#include "../scene.h"

namespace samara::drawings
{
  /** "x y z" with all digits. */
  inline std::string
  text_of(const Vector3 &x, const std::string &separator = " ")
  {
    std::ostringstream text;
    text.precision(17);
    text << x(0) << separator << x(1) << separator << x(2);
    return text.str();
  }

  /** A rigid bar between two places with frames "start" and "end" of these names. */
  inline std::string
  bar(const std::string &name, const std::string &start, const Vector3 &a, const std::string &end, const Vector3 &b)
  {
    return "  subsection " + name + "\n set Type = rigid body\n set Mass = 1\n set Inertia = 0.01, 0.01, 0.01\n" +
           " set Position = " + text_of(0.5 * (a + b), ", ") + "\n set Frames = " + start + " at " + text_of(a) + ", " +
           end + " at " + text_of(b) + "\n end\n";
  }

  inline std::string
  joint(const std::string &name,
        const std::string &kind,
        const std::string &a,
        const std::string &b,
        const std::string &more = "")
  {
    return "  subsection " + name + "\n set Type = " + kind + "\n set Body A = " + a + "\n set Body B = " + b + "\n" +
           more + " end\n";
  }

  /** Lengths of a four-bar; the crank ends at (0.3, 0.4), where it is drawn well. */
  struct Bars
  {
    double coupler = 1, rocker = 0.7, off_plane = 0.02;
    bool   fits = false;

    Eigen::Vector2d
    start() const
    {
      return {0.35, 0.45};
    }
    Eigen::Vector2d
    end(const double y) const
    {
      return {0.35 + std::sqrt(coupler * coupler - std::pow(y - 0.45, 2)), y};
    }
  };

  /** A plane four-bar whose coupler and rocker are drawn roughly, its coupler ending at the height @p y. */
  inline std::string
  four_bar(const Bars &bars, const double y, const std::string &assembly)
  {
    const Vector3 off(0, 0, bars.off_plane);
    Vector3       start(bars.start()(0), bars.start()(1), 0), end(bars.end(y)(0), bars.end(y)(1), 0), foot(1.2, 0, 0),
      top(1.2, y > 0 ? bars.rocker : -bars.rocker, 0);
    start += off;
    end += off;
    std::string place = " set Position = 1.15, 0, 0\n";
    if (bars.fits)
      {
        start = Vector3(0.3, 0.4, 0);
        end = top = Vector3(1.2, 0.75, 0);
        foot      = Vector3(1.15, 0, 0);
      }
    const std::string gap = assembly.find("Gaps") == std::string::npos && !bars.fits ? " set Gap = closed\n" : "";
    return "set Analyses = static\nsubsection Bodies\n" + bar("crank", "foot", {0, 0, 0}, "end", {0.3, 0.4, 0}) +
           bar("coupler", "start", start, "end", end) + bar("rocker", "foot", foot, "end", top) +
           "end\nsubsection Joints\n" + joint("A", "revolute", "ground", "crank.foot") +
           joint("B", "revolute", "crank.end", "coupler.start", gap) +
           joint("C", "revolute", "coupler.end", "rocker.end", gap) +
           joint("D", "revolute", "ground", "rocker.foot", place + gap) + "end\nsubsection Assembly\n" + assembly +
           "\nend\n";
  }

  /** Bodies, joints of a model in a subsystem that is turned and moved; its settings stay outside. */
  inline std::string
  in_subsystem(const std::string &model)
  {
    const auto bodies = model.find("subsection Bodies"), rest = model.find("subsection Assembly");
    return "set Analyses = static\nsubsection Subsystems\n subsection part\n  set Position = 3, -2, 1\n" +
           std::string("  set Rotation = 0.7, 0.3, -0.4\n") + model.substr(bodies, rest - bodies) + " end\nend\n" +
           model.substr(rest);
  }

  /** A portal of two clamped columns and a beam hinged between them, which is drawn 3 cm off and turned by 0.1 rad. */
  inline std::string
  portal(const bool is_rough)
  {
    const auto beam = [](const std::string &name, const Vector3 &a, const Vector3 &b) {
      return "  subsection " + name + "\n set Type = beam\n set Points = " + text_of(a, ", ") + "; " +
             text_of(b, ", ") + "\n set Axis 2 = 0, 1, 0\n set Section = tube\n set Elements = 2\n end\n";
    };
    const Vector3     middle = is_rough ? Vector3(1.01, 0.02, 1.02) : Vector3(1, 0, 1);
    const double      angle  = is_rough ? 0.1 : 0.;
    const Vector3     half(std::cos(angle), std::sin(angle), 0);
    const std::string across = text_of(Vector3(-half(1), half(0), 0), ", ");
    return "set Analyses = modal\nsubsection Sections\n subsection tube\n set Type = tube\n set E = 210e9\n"
           " set Density = 7800\n set Outer radius = 0.01\n end\nend\nsubsection Bodies\n" +
           beam("left", {0, 0, 0}, {0, 0, 1}) + beam("right", {2, 0, 0}, {2, 0, 1}) +
           beam("top", middle - half, middle + half) + "end\nsubsection Joints\n" +
           joint("clamp 1", "rigid", "ground", "left.start") + joint("clamp 2", "rigid", "ground", "right.start") +
           joint(
             "hinge 1", "revolute", "left.end", "top.start", " set Axis = 0, 1, 0\n set Axis on B = " + across + "\n") +
           joint("hinge 2",
                 "universal",
                 "top.end",
                 "right.end",
                 " set Axis = " + across + "\n set Second axis = 0, 0, 1\n") +
           "end\nsubsection Modal\n set Modes = 6\nend\nsubsection Assembly\n set Gaps = closed\nend\n";
  }

  /**
   * Bennett's linkage: four revolutes in space, opposite links alike, a/sin α = b/sin β; it moves. Each of three links
   * is moved and turned by up to @p rough [m, rad], and its axes with it.
   */
  inline std::string
  bennett(const double rough)
  {
    const double a = 0.4, alpha = 0.5, b = 0.7, beta = std::asin(b * std::sin(alpha) / a);
    // the linkage is symmetric about a line: axes z_i at places p_i, closed by its angle θ₁ and tan(θ₁/2) tan(θ₂/2) = …
    const double theta_1 = 1.1, ratio = std::sin(0.5 * (beta + alpha)) / std::sin(0.5 * (beta - alpha)),
                 theta_2 = 2 * std::atan(ratio / std::tan(0.5 * theta_1));
    // Denavit–Hartenberg: turn by θ about z, then along x by the length and turn about x by the twist
    const double         lengths[] = {a, b, a, b}, twists[] = {alpha, beta, alpha, beta};
    const double         angles[] = {theta_1, theta_2, -theta_1, -theta_2};
    std::vector<Vector3> p;
    std::vector<Vector3> z;
    Eigen::Isometry3d    T = Eigen::Isometry3d::Identity();
    for (unsigned int i = 0; i < 4; ++i)
      {
        p.push_back(T.translation());
        z.push_back(T.linear().col(2));
        T = T * Eigen::AngleAxisd(angles[i], Vector3::UnitZ()) * Eigen::Translation3d(lengths[i], 0, 0) *
            Eigen::AngleAxisd(twists[i], Vector3::UnitX());
      }
    std::string  bodies, joints;
    Matrix3      turn[4];
    unsigned int seed = 5;
    const auto   next = [&] {
      seed = 1664525u * seed + 1013904223u;
      return seed / 2147483648. - 1.;
    };
    for (unsigned int i = 0; i < 4; ++i)
      {
        // link i from joint i to joint i + 1; link 3 is the ground's
        const double  by    = i < 3 ? rough : 0;
        const Vector3 about = Vector3(next(), next(), next()).normalized(),
                      shift = by * Vector3(next(), next(), next()), centre = 0.5 * (p[i] + p[(i + 1) % 4]);
        turn[i]       = Eigen::AngleAxisd(by * next(), about).toRotationMatrix();
        const auto at = [&](const Vector3 &x) { return Vector3(centre + shift + turn[i] * (x - centre)); };
        bodies += bar("link " + std::to_string(i), "start", at(p[i]), "end", at(p[(i + 1) % 4]));
      }
    for (unsigned int i = 0; i < 4; ++i)
      {
        const unsigned int before = (i + 3) % 4;
        joints += joint("hinge " + std::to_string(i),
                        "revolute",
                        "link " + std::to_string(before) + ".end",
                        "link " + std::to_string(i) + ".start",
                        " set Axis = " + text_of(turn[before] * z[i], ", ") +
                          "\n set Axis on B = " + text_of(turn[i] * z[i], ", ") + "\n set Gap = closed\n");
      }
    return "set Analyses = static\nsubsection Bodies\n" + bodies + "end\nsubsection Joints\n" + joints +
           joint("clamp", "rigid", "ground", "link 3") + "end\n";
  }

  /** Two rods on the ground by a ball each, drawn apart and turned, with a joint between them. */
  inline std::string
  two_rods(const std::string &kind)
  {
    std::string axes;
    if (kind == "universal")
      axes = " set Axis = 0, 1, 0\n set Second axis = 0.1, 0, 1\n";
    else if (kind != "spherical")
      axes = " set Axis = 0.1, 0.2, 1\n";
    if (kind == "cylindrical" || kind == "prismatic" || kind == "planar")
      axes += " set Axis on B = 0.15, 0.1, 1\n";
    return "set Analyses = static\nsubsection Bodies\n" + bar("one", "foot", {0, 0, 0}, "end", {1, 0, 0}) +
           bar("two", "start", {1.05, 0.02, -0.03}, "end", {1.9, 0.5, 0.1}) + "end\nsubsection Joints\n" +
           joint("ball 1", "spherical", "ground", "one.foot") +
           joint("ball 2", "spherical", "ground", "two.end", " set Position = 1.9, 0.3, 0.12\n set Gap = closed\n") +
           joint("it", kind, "one.end", "two.start", axes + " set Gap = closed\n") + "end\n";
  }
} // namespace samara::drawings

#endif

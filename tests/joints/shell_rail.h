#ifndef samara_tests_joints_shell_rail_h
#define samara_tests_joints_shell_rail_h

#include "../scene.h"

namespace samara
{
  /** A shell, called plate, with a bead that slides along a line of it, called slide. */
  struct ShellRail
  {
    std::string patches = "u, v, 0", mesh = " set Elements = 4, 4\n set Degree = 3\n", shell, bead, line = "line v 0.5",
                kind = "point", slider, displacement, joints, rest;

    std::string
    text() const
    {
      return "subsection Bodies\n subsection plate\n set Type = shell\n set E = 2e6\n set Poisson ratio = 0.3\n"
             " set Patches = " +
             patches + "\n" + mesh + shell +
             " end\n subsection bead\n set Type = rigid body\n set Mass = 0.5\n set Inertia = 0.1, 0.1, 0.1\n" + bead +
             " end\nend\nsubsection Joints\n subsection slide\n set Type = sliding " + kind + "\n set Body A = plate." +
             line + "\n set Body B = bead\n" + slider + " subsection displacement\n" + displacement + " end\n end\n" +
             joints + "end\n" + rest;
    }

    /** With what this model is refused; empty if it is not. */
    std::string
    refusal() const
    {
      try
        {
          Scene scene(text());
        }
      catch (const std::exception &problem)
        {
          return problem.what();
        }
      return "";
    }

    /** Edges that are simply supported, an attitude of the bead held by springs, and a small load on it. */
    void
    support_and_load()
    {
      joints = " subsection x\n set Type = support\n set Along = plate.edge u0, plate.edge u1\n"
               " set Fixed = displacement 1, displacement 2, displacement 3, rotation 1\n end\n"
               " subsection y\n set Type = support\n set Along = plate.edge v0, plate.edge v1\n"
               " set Fixed = displacement 1, displacement 2, displacement 3, rotation 2\n end\n" +
               held_attitude();
      rest = "subsection Loads\n subsection push\n set Type = point load\n set At = bead\n set Force = 0, 0, -1e-6\n"
             " end\nend\n";
    }

    static std::string
    held_attitude()
    {
      return " subsection attitude\n set Type = flexible joint\n set Body A = ground\n set Body B = bead\n"
             " set Rotational stiffness = 1, 1, 1\n end\n";
    }
  };



  /** Entries of a motion without dissipation. */
  inline std::string
  motion_of_rail(const double end, const double step, const unsigned int stages)
  {
    return "set Analyses = dynamic\nsubsection Dynamic\n set End time = " + number_to_text(end) +
           "\n set Step = " + number_to_text(step) + "\n set Stages = " + std::to_string(stages) +
           "\n set Spectral radius = 1\n set Newton tolerance = 1e-12\n set Inconsistent velocities = project\nend\n";
  }



  /**
   * w = 4P/(π⁴ D) ΣΣ sin²(mπx) sin²(nπy)/(m² + n²)² of a simply supported square plate, of 1 m, under a load P = 1e-6 N
   * at (x, y) (Timoshenko & Woinowsky-Krieger); D = E h³/(12 (1 − ν²)) with the material above.
   */
  inline double
  deflection_of_square_plate(const double h, const double x, const double y)
  {
    const double D = 2e6 * h * h * h / (12 * (1 - 0.09)), P = 1e-6;
    double       sum = 0;
    for (unsigned int m = 1; m < 200; ++m)
      for (unsigned int n = 1; n < 200; ++n)
        sum += std::pow(std::sin(m * M_PI * x) * std::sin(n * M_PI * y) / (m * m + n * n), 2);
    return 4 * P / (std::pow(M_PI, 4) * D) * sum;
  }
} // namespace samara

#endif

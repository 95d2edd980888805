#ifndef samara_tests_rotors_h
#define samara_tests_rotors_h

#include <string>

namespace samara
{
  /** How a rotor of two unlike blades turns: by a joint between ground and hub, or ground and all. */
  enum class Turned
  {
    by_joint,
    as_a_whole
  };

  /** A hinged, teetering or hingeless rotor about z at the constant <Omega>; radius 2 m, no weight. */
  inline std::string
  rotor(const std::string &kind, const Turned turned)
  {
    const bool teeters = kind == "teetering";
    const auto blade =
      [&](const std::string &n, const std::string &section, const std::string &root, const std::string &tip) {
        return "  subsection blade " + n + "\n    set Type = beam\n    set Points = " + root + "; " + tip +
               "\n    set Axis 2 = 0, " + (n == "1" ? "1" : "-1") +
               ", 0\n    set Elements = 4\n    set Section = " + section + "\n    set Twist = 0.1 + 0.05*s\n  end\n";
      };
    const auto root_of = [&](const std::string &n) {
      const std::string ends =
        "    set Body A = " + std::string(teeters ? "yoke" : "hub") + "\n    set Body B = blade " + n + ".start\n";
      return "  subsection root " + n + "\n" +
             (kind == "hinged" ?
                "    set Type = universal\n" + ends + "    set Axis = 0, 1, 0\n    set Second axis = 0, 0, 1\n" :
                "    set Type = rigid\n" + ends) +
             "  end\n";
    };
    return std::string(R"(
set Analyses = static, modal
subsection Constants
  set Omega = 30
end
subsection Sections
  subsection stiff
    set Type = engineering constants
    set EA = 1e7
    set GA2 = 3e6
    set GA3 = 2e6
    set GJ = 400
    set EI2 = 300
    set EI3 = 3000
    set Mass = 2
    set I2 = 1e-4
    set I3 = 1e-3
  end
  subsection soft
    set Copy of = stiff
    set GJ = 350
    set EI2 = 250
    set EI3 = 2500
    set Mass = 1.9
  end
end
subsection Bodies
  subsection hub
    set Type = rigid body
    set Mass = 5
    set Inertia = 0.1, 0.1, 0.2
  end
)") +
           (teeters ?
              "  subsection yoke\n    set Type = rigid body\n    set Mass = 1\n    set Inertia = 0.01, 0.01, 0.02\n  end\n" :
              "") +
           blade("1", "stiff", "0.1, 0, 0", "2, 0, 0") + blade("2", "soft", "-0.1, 0, 0", "-2, 0, 0") +
           "end\nsubsection Joints\n" +
           (turned == Turned::by_joint ? "  subsection shaft\n    set Type = revolute\n" :
                                         "  subsection clamp\n    set Type = rigid\n") +
           "    set Body A = ground\n    set Body B = hub\n  end\n" +
           (teeters ?
              "  subsection teeter\n    set Type = revolute\n    set Body A = hub\n    set Body B = yoke\n    set Axis = 0, 1, 0\n  end\n" :
              "") +
           root_of("1") + root_of("2") +
           "end\nsubsection Loads\n  subsection turning\n    set Type = steady rotation\n" +
           (turned == Turned::by_joint ? "    set Joint = shaft\n" : "") +
           "    set Speed = Omega\n  end\nend\nsubsection Modal\n  set Modes = 8\n  set Hold rotations = true\nend\n";
  }
} // namespace samara

#endif

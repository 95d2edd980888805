// The entries of shells and of what holds and loads them: see test_entries.cc.

#include "catalogued.h"

using namespace samara;

namespace
{
  /** Two plates with a corner of half a radian between them, that fly and are bent; and one more without it. */
  std::string
  shell(const std::string &load, const std::string &joint = "")
  {
    return R"(
set Analyses = dynamic
subsection Materials
  subsection ply
    set Type    = isotropic
    set E       = 1e6
    set Density = 1000
  end
end
subsection Layups
  subsection single
    set Plies = ply, 0, 0.05
  end
end
subsection Bodies
  subsection it
    set Type           = shell
    set Patches        = u, 0.5*v, 0; 1 + u*cos(0.5), 0.5*v, u*sin(0.5)
    set Elements       = 2, 1
    set Degree         = 2
    set Crease angle   = 0.4
    set E              = 1e6
    set Thickness      = 0.05
    set Density        = 1000
    set Frames         = place at 0 0 0
  end
  subsection other
    set Type           = shell
    set Patches        = u, 2 + 0.5*v, 0
    set Elements       = 1, 1
    set Degree         = 2
    set E              = 1e6
    set Thickness      = 0.05
    set Density        = 1000
  end
end
subsection Joints
)" + joint +
           R"(
end
subsection Loads
  subsection pull
    set Type   = point load
    set At     = it.at 0 0
    set Force  = 1, 2, 30
  end
)" + load +
           R"(
end
subsection Output
  set Probes = it.at 0 0.position x, it.at 1 1.position y, it.at 1 0.displacement z, it.at 1 0.moment 11, it.at 1 0.force 12, other.at 1 1.velocity z
end
)" + models::two_steps;
  }
} // namespace



TEST_F(Catalogued, Shells)
{
  const std::string plate = shell(""), folder = ScratchFolder().path, no_patches = "Bodies/it/Patches = ";
  // two cells that are bent between them by less than the crease angle
  files["mesh.inp"] = "*NODE\n1,0,0,0\n2,1,0,0\n3,2,0,.3\n4,0,1,0\n5,1,1,0\n6,2,1,.3\n*ELEMENT, TYPE=S4\n"
                      "1,1,2,5,4\n2,2,3,6,5\n";
  const auto joined = [](std::vector<std::string> a, const std::vector<std::string> &b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const std::vector<std::string> places = {"Loads/pull/At = it.at 0 0 0", "Output/Probes = it.at 0 0 0.position x"},
                                 grid   = {no_patches,
                                           "Bodies/it/Grid = hyper_cube",
                                           "Bodies/it/Grid arguments = 0 : 1 : true"};
  check("shell",
        plate,
        "Bodies/it",
        {{"Patches", "u, 0.5*v, 0; 1 + u*cos(0.5), 0.5*v, u*sin(0.4)"},
         {"Elements", "3, 1"},
         {"Mesh", "0.2 1 by 1; 1 by 1"},
         {"Merge", "false"},
         {"Curves", "rail at 2*s, 0.5", {}, true},
         {"Grid", "hyper_cube", joined(places, {"Bodies/it/Grid arguments = 0 : 1 : true"}), false, {no_patches}},
         {"Grid arguments", "0 : 2 : true", joined(places, grid)},
         {"Refinements", "1", joined(places, grid)},
         {"Mesh file", folder + "/mesh.inp", places, false, {no_patches}},
         {"Curved", "false", joined(places, {no_patches, "Bodies/it/Mesh file = " + folder + "/mesh.inp"})},
         {"Degree", "3", {"Loads/pull/Force = 0, 0, 500"}},
         {"Crease angle", "0.6"},
         {"Axis 1", "1, 1, 0"},
         {"Layup", "single", {}, true},                // beside E
         {"Transverse shear", "asymptotic", {}, true}, // likewise
         {"E", "2e6"},
         {"Poisson ratio", "0.2"},
         {"Thickness", "0.06"},
         {"Density", "900"},
         {"Offset", "0.02"},
         {"Damping", "0.01"},
         {"Frames", "place at 0.5 1", {"Loads/pull/At = it.place"}},
         {"Rigid edges", "root at edge u0"},
         {"Rigid", "true", {"Output/Probes = it.at 0 0.position x"}},
         {"Layers in pictures", "true", {"Dynamic/Pictures = 1"}},
         {"Velocity", "0.1, 0, 0"},
         {"Angular velocity", "0.3, 0.2, -0.6"}},
        {{"Patch layups", "one layup a patch: tests/shells/test_patch_layups.cc"},
         {"Region layups", "likewise: tests/shells/test_regions.cc"}});
  check("support",
        shell("", "subsection it\n set Type = support\n set Along = it.edge u0\n set Fixed = displacement 3\nend\n"),
        "Joints/it",
        {{"Along", "it.edge v0"},
         {"Fixed", "displacement 3, rotation 1"},
         {"Axis", "1, 0, 1"},
         {"Axis 1", "1, 1, 0", {"Joints/it/Fixed = displacement 1"}}});
  check("distributing",
        shell("", "subsection it\n set Type = distributing\n set Along = it.edge u0\n set Body = other.at 0 0\nend\n"),
        "Joints/it",
        {{"Along", "it.edge v0"}, {"Body", "other.at 1 0"}});
  check("area load",
        shell("subsection it\n set Type = area load\n set Body = it\n set Force = 1, 2, 3\nend\n"),
        "Loads/it",
        {{"Body", "other"}, {"Region", "patch 2"}, {"Force", "1, 2, 4"}, {"Moment", "1, 2, 3"}, {"Axes", "body"}});
  check("pressure",
        shell("subsection it\n set Type = pressure\n set Body = it\n set Pressure = 10\nend\n"),
        "Loads/it",
        {{"Body", "other"}, {"Region", "patch 2"}, {"Pressure", "12"}});
}

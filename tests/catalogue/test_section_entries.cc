// The entries of sections, materials and layups: see test_entries.cc.

#include <samara/cosserat/beamdyn_file.h>
#include <samara/cosserat/section_file.h>

#include "catalogued.h"

using namespace samara;

namespace
{
  /** A twisted cantilever with a section <it> of the given entries, one of materials <metal>, <ply> and <lattice>. */
  std::string
  analysed(const std::string &section)
  {
    return R"(
set Analyses = static, section
subsection Materials
  subsection metal
    set Type    = isotropic
    set E       = 1e6
    set Density = 1000
  end
  subsection ply
    set Type    = orthotropic
    set E1      = 2e6
    set E2      = 1e6
    set G12     = 3e5
    set nu12    = 0.2
    set Density = 1000
  end
  subsection lattice
    set Type      = anisotropic
    set Stiffness = 1e6, 2e6, 3e6, 4e5, 5e5, 6e5
  end
end
subsection Layups
  subsection skin
    set Material      = ply
    set Angles        = 0/30
    set Ply thickness = 0.01
  end
  subsection thick
    set Material      = ply
    set Angles        = 20
    set Ply thickness = 0.03
  end
end
subsection Sections
  subsection it
)" + section +
           R"(    set Degree   = 2
    set Elements = 2
  end
  subsection other
    set Type         = tube
    set E            = 1e6
    set Density      = 1000
    set Outer radius = 0.05
  end
end
subsection Bodies
  subsection beam
    set Type     = beam
    set Points   = 0, 0, 0; 1, 0, 0
    set Section  = it
    set Twist    = 0.3*s
    set Elements = 1
    set Degree   = 2
  end
end
subsection Joints
  subsection clamp
    set Type   = rigid
    set Body A = ground
    set Body B = beam.start
  end
end
subsection Loads
  subsection push
    set Type   = point load
    set At     = beam.end
    set Force  = 0.01, 0.02, 0.03
    set Moment = 0.003, 0.002, 0.001
  end
end
subsection Output
  set Probes = beam.end.position x, beam.end.position y, beam.end.rotation x
end
subsection Static
end
subsection Section
  set Stresses at = beam.middle
end
)";
  }
} // namespace



TEST_F(Catalogued, Sections)
{
  const Change                   radii     = {"Drawn radii", "0.02, 0.03"};
  const std::vector<std::string> trapeze   = {"Sections/it/Trapeze coupling = 2000",
                                              "Sections/it/Trapeze stiffness = 2000"},
                                 trapeze_6 = {"Sections/it/Trapeze coupling = 2000, 0, 0, 0, 0, 0",
                                              "Sections/it/Trapeze stiffness = 2000"};
  check("engineering constants",
        models::beam(models::engineering_constants),
        "Sections/it",
        {{"EA", "2e4"},
         {"GA2", "6e3"},
         {"GA3", "6e3"},
         {"GJ", "25"},
         {"EI2", "35"},
         {"EI3", "45"},
         {"EI23", "5"},
         {"Shear centre", "0.01, 0.02"},
         {"Tension centre", "0.01, 0.02"},
         {"Mass", "3"},
         {"Mass centre", "0.01, 0.02"},
         {"I2", "0.02"},
         {"I3", "0.01"},
         {"I23", "0.001"},
         {"Trapeze coupling", "3000", trapeze},
         {"Trapeze stiffness", "4000", trapeze},
         radii});
  check("matrices",
        models::beam(models::matrices),
        "Sections/it",
        {{"Stiffness", "1e4, 5e3, 4e3, 20, 30, 50"},
         {"Compliance", "1e-4, 2e-4, 3e-4, 0.1, 0.02, 0.03", {}, false, {"Sections/it/Stiffness = "}},
         {"Inertia", "2, 2, 2, 0.03, 0.01, 0.03"},
         {"Trapeze coupling", "3000, 0, 0, 0, 0, 0", trapeze_6},
         {"Trapeze stiffness", "4000", trapeze_6},
         radii});
  const std::map<std::string, std::string> analysed = {{"Material", "analysed, see there"},
                                                       {"Layup", "analysed, see there"},
                                                       {"Degree", "analysed, see there"},
                                                       {"Elements", "analysed, see there"},
                                                       {"Elements per ply", "analysed, see there"},
                                                       {"Position", "analysed, see there"},
                                                       {"Rotation", "analysed, see there"},
                                                       {"Initial curvature", "analysed, see there"}};
  check("rectangle",
        models::beam(models::rectangle),
        "Sections/it",
        {{"E", "2e6"},
         {"Poisson ratio", "0.2"},
         {"Density", "900"},
         {"Width 2", "0.06"},
         {"Width 3", "0.09"},
         {"Trapeze effect", "true"},
         {"Shear factor", "0.5"}},
        analysed);
  check("tube",
        models::beam(models::tube),
        "Sections/it",
        {{"E", "2e6"},
         {"Poisson ratio", "0.2"},
         {"Density", "900"},
         {"Outer radius", "0.06"},
         {"Inner radius", "0.04"},
         {"Trapeze effect", "true"},
         {"Shear factor", "0.5"}},
        analysed);

  const std::string folder = ScratchFolder().path; // that of the runs
  files["table.csv"]       = "x,EA,GA2,GA3,GJ,EI2,EI3,mass,I2,I3\n0,1e4,1e4,1e4,30,20,20,2,.01,.01\n"
                             "1,1e4,1e4,1e4,30,20,20,2,.01,.01\n";
  files["ratio.csv"]       = "r/R,EA,GA2,GA3,GJ,EI2,EI3,mass,I2,I3\n0,1e4,1e4,1e4,30,20,20,2,.01,.01\n"
                             "9,3e4,3e4,3e4,90,60,60,6,.03,.03\n";
  check("table",
        models::beam(models::table),
        "Sections/it",
        {{"Stations", "other at 0, thick at 1"},
         {"Start", "0.5", {"Sections/it/Stations = other at 0 m, thick at 2 m"}},
         {"File", folder + "/table.csv", {}, false, {"Sections/it/Stations = "}},
         {"Radius",
          "2",
          {"Sections/it/File = " + folder + "/ratio.csv", "Sections/it/Stations = ", "Sections/it/Radius = 1"}}});

  for (const double stiffness : {1., 2.})
    {
      const std::string number = stiffness == 1 ? "one" : "two";
      SectionFile       file{"it", Vector3::Zero(), {}};
      file.values.stiffness  = stiffness * Vector6(2e4, 6e3, 6e3, 25, 35, 45).asDiagonal().toDenseMatrix();
      file.values.inertia    = Vector6(3, 3, 3, 0.03, 0.02, 0.01).asDiagonal();
      files[number + ".txt"] = file.write(16);
      const auto  &v         = file.values;
      BeamDynBlade blade{{{0, v.stiffness, v.inertia}, {1, v.stiffness, v.inertia}}, Vector6::Zero()};
      files[number + ".dat"] = blade.write("a blade");
      blade.stations[1].inertia(3, 3) *= 1.01;
      files["loose_" + number + ".dat"] = blade.write("a blade with a wrong polar moment");
    }
  check("file",
        models::beam("    set Type = file\n    set File = " + folder + "/one.txt\n    set Initial curvature = any\n"),
        "Sections/it",
        {{"File", folder + "/two.txt"}, {"Initial curvature", "of the file", {"Bodies/beam/Twist = 0.3*s"}, true}});
  check("BeamDyn",
        models::beam("    set Type = BeamDyn\n    set File = " + folder +
                     "/loose_one.dat\n    set Inertia tolerance = 0.1\n"),
        "Sections/it",
        {{"File", folder + "/two.dat"}, {"Inertia tolerance", "0.001", {}, true}});
}



TEST_F(Catalogued, MaterialsAndLayups)
{
  const std::string rectangle = "    set Type = rectangle\n    set Width 2 = 0.1\n    set Width 3 = 0.05\n",
                    metal     = analysed(rectangle + "    set Material = metal\n"),
                    ply       = analysed(rectangle + "    set Material = ply\n"),
                    lattice   = analysed(rectangle + "    set Material = lattice\n"),
                    skin      = analysed("    set Type = rectangle\n    set Width 2 = 0.1\n    set Layup = skin\n");
  const Changes common        = {{"Density", "900"},
                                 {"Tensile strength", "1e3"},
                                 {"Compressive strength", "1e3"},
                                 {"Shear strength", "1e3"}};
  check("isotropic",
        metal,
        "Materials/metal",
        joined(common, {{{"E", "2e6"}, {"Poisson ratio", "0.2"}, {"Yield stress", "1e3"}}}));
  check("orthotropic",
        ply,
        "Materials/ply",
        joined(common,
               {{{"E1", "3e6"},
                 {"E2", "1.1e6"},
                 {"E3", "1.1e6"},
                 {"G12", "4e5"},
                 {"G13", "4e5"},
                 {"G23", "4e5"},
                 {"nu12", "0.3"},
                 {"nu13", "0.3"},
                 {"nu23", "0.3"}}}));
  check(
    "anisotropic",
    lattice,
    "Materials/lattice",
    joined(common,
           {{{"Stiffness", "1e6, 2e6, 4e6, 4e5, 5e5, 7e5"},
             {"Compliance", "1e-6, 1e-6, 1e-6, 2e-6, 2e-6, 2e-6", {}, false, {"Materials/lattice/Stiffness = "}}}}));
  const std::vector<std::string> no_short = {
    "Layups/skin/Material = ", "Layups/skin/Angles = ", "Layups/skin/Ply thickness = 0"};
  check("layup",
        skin,
        "Layups/skin",
        {{"Material", "metal"},
         {"Angles", "0/40"},
         {"Ply thickness", "0.02"},
         {"Symmetric", "true"},
         {"Plies", "ply, 0, 0.01; metal, 0, 0.02", {}, false, no_short}});
}



TEST_F(Catalogued, AnalysedSections)
{
  const Changes                            common      = {{"Degree", "3"},
                                                          {"Elements", "8"},
                                                          {"Elements per ply", "2"},
                                                          {"Position", "0.01, 0.02"},
                                                          {"Rotation", "0.3"},
                                                          {"Trapeze effect", "true"},
                                                          {"Initial curvature", "none"}};
  const std::map<std::string, std::string> closed_form = {{"E", "closed form, see there"},
                                                          {"Poisson ratio", "closed form, see there"},
                                                          {"Density", "closed form, see there"},
                                                          {"Shear factor", "closed form, see there"}};
  const Change                             material    = {"Material", "ply"};
  check("rectangle",
        analysed("    set Type = rectangle\n    set Width 2 = 0.1\n    set Width 3 = 0.05\n    set Material = metal\n"),
        "Sections/it",
        joined(common, {{material, {"Width 2", "0.2"}, {"Width 3", "0.2"}, {"Layup", "skin", {}, true}}}),
        closed_form);
  check("tube",
        analysed(
          "    set Type = tube\n    set Outer radius = 0.1\n    set Inner radius = 0.05\n    set Material = metal\n"),
        "Sections/it",
        joined(common, {{material, {"Outer radius", "0.2"}, {"Inner radius", "0.02"}, {"Layup", "skin", {}, true}}}),
        closed_form);
  auto of_ellipse = common;
  of_ellipse.erase(of_ellipse.begin() + 2);
  check("ellipse",
        analysed("    set Type = ellipse\n    set Radius 2 = 0.1\n    set Radius 3 = 0.05\n    set Material = metal\n"),
        "Sections/it",
        joined(of_ellipse, {{material, {"Radius 2", "0.2"}, {"Radius 3", "0.2"}}}),
        {{"Elements per ply", "there are no plies"}});
  check("box",
        analysed("    set Type = box\n    set Width 2 = 0.2\n    set Width 3 = 0.15\n    set Thickness = 0.02\n"
                 "    set Material = metal\n"),
        "Sections/it",
        joined(common,
               {{material,
                 {"Width 2", "0.3"},
                 {"Width 3", "0.3"},
                 {"Thickness", "0.03"},
                 {"Layup", "skin"},
                 {"Layup of bottom", "skin"},
                 {"Layup of right", "skin"},
                 {"Layup of top", "skin"},
                 {"Layup of left", "skin"}}}));
  check("I",
        analysed("    set Type = I\n    set Height = 0.2\n    set Lower width = 0.1\n    set Lower thickness = 0.01\n"
                 "    set Web thickness = 0.01\n    set Material = metal\n"),
        "Sections/it",
        joined(common,
               {{material,
                 {"Height", "0.3"},
                 {"Lower width", "0.2"},
                 {"Upper width", "0.2"},
                 {"Lower thickness", "0.02"},
                 {"Upper thickness", "0.02"},
                 {"Web thickness", "0.02"},
                 {"Lower layup", "skin"},
                 {"Upper layup", "skin"},
                 {"Web layup", "skin"}}}));
  check("C",
        analysed("    set Type = C\n    set Height = 0.2\n    set Width = 0.1\n    set Flange thickness = 0.01\n"
                 "    set Web thickness = 0.01\n    set Material = metal\n"),
        "Sections/it",
        joined(common,
               {{material,
                 {"Height", "0.3"},
                 {"Width", "0.2"},
                 {"Flange thickness", "0.02"},
                 {"Web thickness", "0.02"},
                 {"Lower layup", "skin"},
                 {"Upper layup", "skin"},
                 {"Web layup", "skin"}}}));
  check("section",
        analysed("    set Type = ellipse\n    set Radius 2 = 0.1\n    set Radius 3 = 0.05\n    set Material = metal\n"),
        "Section",
        {{"Sections", "other"},
         {"Stresses at", "beam at 0.3"},
         {"BeamDyn files", "beam"},
         {"Largest of", "beam", {"Materials/metal/Tensile strength = 1e4"}},
         {"Criterion", "von Mises", {"Materials/metal/Tensile strength = 1e4", "Section/Largest of = beam"}, true}});
}



TEST_F(Catalogued, SectionsFromOutlinesAndMeshes)
{
  const std::string folder = ScratchFolder().path; // that of the runs
  files["airfoil.dat"]     = "1 0\n0.8 0.04\n0.5 0.08\n0.2 0.08\n0.05 0.06\n0 0\n0.05 -0.06\n0.2 -0.08\n0.5 -0.08\n"
                             "0.8 -0.04\n1 0\n";
  const std::vector<std::string> nose   = {"Sections/it/Nose material = metal", "Sections/it/Nose to = 0.1"};
  const Changes                  common = {{"Degree", "3"},
                                           {"Position", "0.01, 0.02"},
                                           {"Rotation", "0.3"},
                                           {"Trapeze effect", "true"},
                                           {"Initial curvature", "none"}};
  check("airfoil",
        analysed("    set Type = airfoil\n    set NACA = 0018\n    set Chord = 1\n    set Material = metal\n"
                 "    set Thickness = 0.01\n"),
        "Sections/it",
        joined(common,
               {{{"Elements", "8"},
                 {"Elements per ply", "2"},
                 {"NACA", "2418"},
                 {"NACA trailing edge", "sharp"},
                 {"Coordinates", folder + "/airfoil.dat", {}, false, {"Sections/it/NACA = "}},
                 {"Chord", "1.1"},
                 {"Origin", "0.3"},
                 {"Layup", "skin", {}, true},
                 {"Material", "ply"},
                 {"Thickness", "0.012"},
                 {"Skins", "upper, 0.3, 0.5, skin"},
                 {"Spar caps", "upper, 0.3, 0.5, skin"},
                 {"Webs", "0.3, skin"},
                 {"Trailing edge material", "ply"},
                 {"Trailing edge from", "0.7"},
                 {"Trailing edge skins", "true", {"Sections/it/Trailing edge material = ply"}},
                 {"Nose material", "ply", nose},
                 {"Nose to", "0.12", nose}}}));

  // four cells, with a slit from the middle to the side between two of them
  for (const double width : {0.1, 0.2})
    {
      std::string nodes;
      for (unsigned int i = 0; i < 9; ++i)
        nodes += std::to_string(i + 1) + "," + number_to_text(width * (i % 3) / 2) + "," +
                 number_to_text(0.05 * (i / 3)) + "\n";
      files[width < 0.15 ? "narrow.inp" : "wide.inp"] =
        "*NODE\n" + nodes + "10," + number_to_text(width) + ",0.05\n" +
        "*ELEMENT, TYPE=CPS4, ELSET=all\n1,1,2,5,4\n2,2,3,6,5\n3,4,5,8,7\n4,5,10,9,8\n";
    }
  std::string mesh =
    analysed("    set Type = mesh\n    set Mesh file = " + folder + "/narrow.inp\n    set Groups = all, metal\n");
  mesh.erase(mesh.find("    set Elements = 2\n"), 21);
  check("mesh",
        mesh,
        "Sections/it",
        joined(common,
               {{{"Mesh file", folder + "/wide.inp"},
                 {"Groups", "all, ply, 20, 30"},
                 {"Length unit", "1.1"},
                 {"Merge", "true"}}}),
        {{"Elements", "the mesh has them"}, {"Elements per ply", "the mesh has them"}});
}

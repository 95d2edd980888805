#ifndef samara_tests_skeleton_scene_h
#define samara_tests_skeleton_scene_h

#include <samara/analysis/modal.h>
#include <samara/analysis/skeleton.h>
#include <samara/analysis/static.h>
#include <samara/cosserat/skeleton.h>
#include <samara/input/input.h>
#include <samara/joints/skeleton.h>
#include <samara/loads/skeleton.h>
#include <samara/states/skeleton.h>
#include <samara/time/skeleton.h>

#include "../base/temporary_folder.h"
#include "../complex_step.h"
#include <gtest/gtest.h>

#include <sstream>

namespace samara
{
  /** This is all a new kind needs to be known: the line that would stand in source/input/catalogue.cc. */
  inline Catalogue
  catalogue_with_skeletons()
  {
    Catalogue catalogue;
    for (auto &group : catalogue.groups)
      {
        if (group.subsection == "Joints")
          {
            group.kinds.add<SlottedPin>("slotted pin", "a pin that slides in a slot and turns");
            group.kinds.add<Strut>("strut", "elastic line between two points");
          }
        if (group.subsection == "Loads")
          group.kinds.add<PointDrag>("point drag", "drag of the air at a point");
        if (group.subsection == "States")
          group.kinds.add<Servo>("servo", "follows a signal with a lag and a largest rate");
      }
    catalogue.analyses.add<MassReport>("mass", "mass, centre and inertia of the whole model");
    catalogue.integrators->add<ExplicitMidpoint>("explicit midpoint", "of second order, for what is not stiff");
    return catalogue;
  }

  inline const std::string two_blocks = R"(
subsection Bodies
  subsection a
    set Type = rigid body
    set Mass = 3
    set Inertia = 0.3, 0.4, 0.5
    set Rotation = 0.2, -0.1, 0.4
    set Frames = ear at 0.2 0.1 0.3
  end
  subsection b
    set Type = rigid body
    set Mass = 2
    set Inertia = 0.1, 0.1, 0.1
    set Position = 1, 0.2, -0.3
    set Frames = ear at 0.9 0.5 0.1
  end
end
)";

  struct SmallScene
  {
    explicit SmallScene(const std::string &text, const Catalogue &catalogue = catalogue_with_skeletons())
      : input(catalogue, folder.write("model.prm", text))
      , system(input.model)
      , log(stream)
      , context{system, log, "", {}, false, system.reference(), {}, {}}
    {}

    TemporaryFolder    folder;
    Input              input;
    System             system;
    std::ostringstream stream;
    Log                log;
    Context            context;

    double
    value(const std::string &probe) const
    {
      return input.model.probe(probe).value(context.state);
    }

    void
    find_equilibrium()
    {
      StaticAnalysis analysis;
      analysis.start(context);
      analysis.run(context);
    }

    /** The analysis of the file, the first if there are several. */
    template <typename Kind>
    Kind &
    analysis()
    {
      return dynamic_cast<Kind &>(*input.analyses.at(0));
    }
  };

  /** What the program says to a model. */
  inline std::string
  complaint(const std::string &text)
  {
    try
      {
        SmallScene scene(text);
        return "";
      }
    catch (const InputError &error)
      {
        return error.what();
      }
  }

  inline std::string
  joint(const std::string &name, const std::string &entries)
  {
    return "subsection Joints\n subsection " + name + "\n" + entries + "\n end\nend\n";
  }

  inline bool
  contains(const std::string &text, const std::string &piece)
  {
    return text.find(piece) != std::string::npos;
  }
} // namespace samara

#endif

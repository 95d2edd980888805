#include <samara/analysis/dynamic.h>
#include <samara/analysis/modal.h>
#include <samara/analysis/static.h>
#include <samara/catalogue.h>
#include <samara/cosserat/beam.h>
#include <samara/cosserat/rigid_body.h>
#include <samara/cosserat/section_kinds.h>
#include <samara/joints/flexible_joint.h>
#include <samara/joints/lower_pairs.h>
#include <samara/joints/other_joints.h>
#include <samara/joints/rolling.h>
#include <samara/loads/loads.h>
#include <samara/section/layup.h>
#include <samara/section_report.h>
#include <samara/states/first_order.h>

namespace samara
{
  Catalogue::Catalogue()
  {
    Registry<Item> materials;
    materials.add<IsotropicMaterial>("isotropic", "material with the same stiffness in all directions");
    materials.add<OrthotropicMaterial>("orthotropic", "material with three planes of symmetry, as a ply");
    materials.add<AnisotropicMaterial>("anisotropic", "material of any stiffness");

    Registry<Item> layups;
    layups.add<Layup>("layup", "plies one upon the other");

    Registry<Item> sections;
    sections.add<EngineeringSection>("engineering constants", "stiffnesses and masses by name, with centres");
    sections.add<MatrixSection>("matrices", "full 6x6 stiffness or compliance and inertia");
    sections.add<TableSection>("table", "properties that vary along the beam");
    sections.add<RectangularSection>("rectangle", "solid rectangle, or strip of plies");
    sections.add<TubularSection>("tube", "circular tube or rod");
    sections.add<EllipticSection>("ellipse", "solid ellipse");
    sections.add<BoxSection>("box", "hollow rectangle with a layup on each wall");
    sections.add<ISection>("I", "two flanges and a web between them");
    sections.add<ChannelSection>("C", "channel: two flanges and a web on their left");

    Registry<Item> bodies;
    bodies.add<RigidBody>("rigid body", "one node with mass and inertia");
    bodies.add<Beam>("beam", "geometrically exact composite beam");

    Registry<Item> joints;
    joints.add<Revolute>("revolute", "hinge about axis 3");
    joints.add<Prismatic>("prismatic", "slide along axis 3");
    joints.add<Screw>("screw", "rotation about axis 3 with proportional displacement");
    joints.add<Cylindrical>("cylindrical", "rotation about and displacement along axis 3");
    joints.add<Planar>("planar", "sliding on the plane normal to axis 3");
    joints.add<Spherical>("spherical", "ball joint");
    joints.add<Universal>("universal", "two hinges at a right angle");
    joints.add<Rigid>("rigid", "weld, however far apart");
    joints.add<Spring>("spring", "spring, damper or actuator between two points");
    joints.add<Distance>("distance", "massless rod between two points");
    joints.add<Gear>("gear", "ratio between the rotations of two joints");
    joints.add<FlexibleJoint>("flexible joint", "six springs and dampers");
    joints.add<RollingBall>("rolling ball", "ball that rolls on a plane without slipping");
    joints.add<KnifeEdge>("knife edge", "blade or wheel that does not move sideways");

    Registry<Item> loads;
    loads.add<Gravity>("gravity", "weight of everything");
    loads.add<ConcentratedLoad>("point load", "force and moment at a point of a body");
    loads.add<LineLoad>("line load", "force and moment per length of a beam");
    loads.add<SteadyRotation>("steady rotation", "rotation of the model, or of a joint with what it carries along");

    Registry<Item> states;
    states.add<FirstOrder>("first order", "a state with a rate: a filter, a lag, an integral");

    groups = {{"Materials", "material", materials},
              {"Layups", "layup", layups, "layup"},
              {"Sections", "section", sections},
              {"States", "state", states, "first order"},
              {"Bodies", "body", bodies},
              {"Joints", "joint", joints},
              {"Loads", "load", loads}};

    analyses.add<StaticAnalysis>("static", "equilibrium under loads and steady rotation");
    analyses.add<ModalAnalysis>("modal", "complex modes about the state reached");
    analyses.add<DynamicAnalysis>("dynamic", "motion in time");
    analyses.add<SectionReport>("section", "stiffness and centres of cross-sections, and stresses in them");
  }
} // namespace samara

#include <samara/aero/airfoil_table.h>
#include <samara/aero/helical_wake.h>
#include <samara/aero/momentum_inflow.h>
#include <samara/aero/surface.h>
#include <samara/analysis/dynamic.h>
#include <samara/analysis/floquet.h>
#include <samara/analysis/harmonics.h>
#include <samara/analysis/linear_system.h>
#include <samara/analysis/lyapunov.h>
#include <samara/analysis/modal.h>
#include <samara/analysis/periodic_linear_system.h>
#include <samara/analysis/static.h>
#include <samara/analysis/trim.h>
#include <samara/analysis/verification.h>
#include <samara/cosserat/airfoil_section.h>
#include <samara/cosserat/beam.h>
#include <samara/cosserat/beamdyn_file.h>
#include <samara/cosserat/geodesic_beam.h>
#include <samara/cosserat/mesh_section.h>
#include <samara/cosserat/mitc4_shell.h>
#include <samara/cosserat/rigid_body.h>
#include <samara/cosserat/section_file.h>
#include <samara/cosserat/section_kinds.h>
#include <samara/cosserat/shell.h>
#include <samara/cosserat/table_section.h>
#include <samara/input/catalogue.h>
#include <samara/joints/body_contact.h>
#include <samara/joints/buffer.h>
#include <samara/joints/contacts_item.h>
#include <samara/joints/distributing.h>
#include <samara/joints/fixed_springs.h>
#include <samara/joints/flexible_joint.h>
#include <samara/joints/lower_pairs.h>
#include <samara/joints/other_joints.h>
#include <samara/joints/partial_joints.h>
#include <samara/joints/point_on_curve.h>
#include <samara/joints/rolling.h>
#include <samara/joints/rolling_disc.h>
#include <samara/joints/sliding.h>
#include <samara/joints/support.h>
#include <samara/loads/loads.h>
#include <samara/loads/surface_loads.h>
#include <samara/model/probe_quantity.h>
#include <samara/recovery/section_report.h>
#include <samara/section/layup.h>
#include <samara/states/control.h>
#include <samara/states/controller.h>
#include <samara/states/first_order.h>
#include <samara/time/rival_alpha.h>
#include <samara/time/rival_bdf.h>
#include <samara/time/rival_energy_decaying.h>
#include <samara/time/stage_integrator.h>

namespace samara
{
  namespace
  {
    Registry<Item>
    catalogue_of_sections()
    {
      Registry<Item> sections;
      sections.add<EngineeringSection>("engineering constants", "stiffnesses and masses by name, with centres");
      sections.add<MatrixSection>("matrices", "full 6x6 stiffness or compliance and inertia");
      sections.add<TableSection>("table", "properties that vary along the beam");
      sections.add<FileSection>("file", "6x6 matrices from a file that the analysis of a section has written");
      sections.add<BeamDynSection>("BeamDyn", "stations along a blade from a blade file of BeamDyn");
      sections.add<RectangularSection>("rectangle", "solid rectangle, or strip of plies");
      sections.add<TubularSection>("tube", "circular tube or rod");
      sections.add<EllipticSection>("ellipse", "solid ellipse");
      sections.add<BoxSection>("box", "hollow rectangle with a layup on each wall");
      sections.add<ISection>("I", "two flanges and a web between them");
      sections.add<ChannelSection>("C", "channel: two flanges and a web on their left");
      sections.add<MeshSection>("mesh", "quadrilaterals and triangles of Gmsh or Abaqus");
      sections.add<AirfoilSection>("airfoil",
                                   "skins, spar caps, webs and a trailing edge in an outline by coordinates");
      return sections;
    }



    Registry<Item>
    catalogue_of_joints()
    {
      Registry<Item> joints;
      joints.add<Revolute>("revolute", "hinge about axis 3");
      joints.add<Prismatic>("prismatic", "slide along axis 3");
      joints.add<Screw>("screw", "rotation about axis 3 with proportional displacement");
      joints.add<Cylindrical>("cylindrical", "rotation about and displacement along axis 3");
      joints.add<Planar>("planar", "sliding on the plane normal to axis 3");
      joints.add<Spherical>("spherical", "ball joint");
      joints.add<Universal>("universal", "two hinges at a right angle");
      joints.add<SkewUniversal>("skew universal", "two hinges at any angle");
      joints.add<ConstantVelocity>("constant velocity", "shafts that bend and turn with the same speed");
      joints.add<InLine>("in line", "a point on a line, free to turn");
      joints.add<InPlane>("in plane", "a point on a plane, free to turn");
      joints.add<PointOnCurve>("point on curve", "a point on a curve, free to turn");
      joints.add<SlidingPoint>("sliding point", "a point that slides along a beam, free to turn");
      joints.add<SlidingSleeve>("sliding sleeve", "a ring that slides along a beam and turns about it");
      joints.add<SlidingPrismatic>("sliding prismatic", "a slider on a beam that turns with its sections");
      joints.add<SlidingScrew>("sliding screw", "a nut on a beam: it turns in proportion to how far it slides");
      joints.add<Rigid>("rigid", "weld, however far apart");
      joints.add<Spring>("spring", "spring, damper or actuator between two points");
      joints.add<Distance>("distance", "massless rod between two points");
      joints.add<Buffer>("buffer", "keeps two apart that slide on one beam");
      joints.add<Gear>("gear", "ratio between the rotations of two joints");
      joints.add<FlexibleJoint>("flexible joint", "six springs and dampers");
      joints.add<FixedSprings>("springs in fixed axes", "three springs and dampers that do not turn with the bodies");
      joints.add<RollingBall>("rolling ball", "ball that rolls on a plane without slipping");
      joints.add<Support>("support", "holds points and edges of shells on the ground");
      joints.add<Distributing>("distributing", "attaches a body to the mean motion of edges of shells");
      joints.add<RollingDisc>("rolling disc", "wheel that rolls and tilts on a plane without slipping");
      joints.add<KnifeEdge>("knife edge", "blade or wheel that does not move sideways");
      joints.add<BallOnPlane>("ball on plane", "contact of a ball and a plane, with friction");
      joints.add<BallOnBall>("ball on ball", "contact of two balls, or of a ball in a hollow one, with friction");
      joints.add<EllipsoidOnPlane>(
        "ellipsoid on plane", "contact of an ellipsoid, or of a disc with a round rim, and a plane, with friction");
      joints.add<BallOnCylinder>("ball on cylinder",
                                 "contact of a ball and a cylinder, or of a ball in a tube, with friction");
      joints.add<ContactsItem>("contacts", "a group of balls, planes, cylinders and beams any of which may touch");
      return joints;
    }


    Registry<Item>
    catalogue_of_materials()
    {
      Registry<Item> materials;
      materials.add<IsotropicMaterial>("isotropic", "material with the same stiffness in all directions");
      materials.add<OrthotropicMaterial>("orthotropic", "material with three planes of symmetry, as a ply");
      materials.add<AnisotropicMaterial>("anisotropic", "material of any stiffness");
      return materials;
    }



    Registry<Item>
    catalogue_of_bodies()
    {
      Registry<Item> bodies;
      bodies.add<RigidBody>("rigid body", "one node with mass and inertia");
      bodies.add<Beam>("beam", "geometrically exact composite beam");
      bodies.add<Shell>("shell", "geometrically exact shell");
      bodies.add<GeodesicBeam>("geodesic beam",
                               "prototype: beam of two nodes an element that turns about one axis between them");
      bodies.add<Mitc4Shell>("MITC4 shell", "prototype: shell of four nodes an element with the shear of its sides");
      return bodies;
    }



    Registry<Item>
    catalogue_of_loads()
    {
      Registry<Item> loads;
      loads.add<Gravity>("gravity", "weight of everything");
      loads.add<ConcentratedLoad>("point load", "force and moment at a point of a body");
      loads.add<LineLoad>("line load", "force and moment per length of a beam or an edge");
      loads.add<AreaLoad>("area load", "force and moment per area of a shell");
      loads.add<Pressure>("pressure", "force along the normal of a shell that follows it");
      loads.add<SteadyRotation>("steady rotation", "rotation of the model, or of a joint with what it carries along");
      return loads;
    }



    Registry<Item>
    catalogue_of_states()
    {
      Registry<Item> states;
      states.add<FirstOrder>("first order", "a state with a rate: a filter, a lag, an integral");
      states.add<Control>("control", "a number that keeps its value in motion, for trim to choose");
      states.add<PidController>("PID", "a controller by error, integral and rate, between limits");
      states.add<TransferFunction>("transfer function", "output by input, a quotient of polynomials of s");
      states.add<StateSpace>("state space", "outputs by inputs, with matrices A, B, C, D");
      states.add<Delay>("delay", "what the input was some time ago, by a Pade approximant");
      return states;
    }



    Registry<Item>
    catalogue_of_airfoils()
    {
      Registry<Item> airfoils;
      airfoils.add<AnalyticAirfoil>("analytic", "coefficients in closed form");
      airfoils.add<C81Airfoil>("C81", "tables of coefficients over angle of attack and Mach number");
      airfoils.add<AeroDynAirfoil>("AeroDyn", "polars in the format of AeroDyn");
      return airfoils;
    }



    Registry<Item>
    catalogue_of_aerodynamics()
    {
      Registry<Item> aerodynamics;
      aerodynamics.add<Air>("air", "density, speed of sound and wind");
      aerodynamics.add<PrescribedInflow>("prescribed inflow", "flow through a rotor's disk, given");
      aerodynamics.add<UniformInflow>("uniform inflow", "mean flow through a rotor's disk, with its time constant");
      aerodynamics.add<PittPetersInflow>("Pitt-Peters inflow", "mean flow and its gradients, three states");
      aerodynamics.add<PetersHeInflow>("Peters-He inflow", "harmonics and radial shapes, any number of states");
      aerodynamics.add<HelicalWake>("helical wake", "flow of vortex lines behind blades, a prescribed wake");
      aerodynamics.add<AnnularInflow>(
        "annular inflow", "blade elements: momentum of each annulus, tip loss, high thrust, two states a station");
      return aerodynamics;
    }



    std::shared_ptr<Integrators>
    catalogue_of_integrators()
    {
      const auto integrators = std::make_shared<Integrators>();
      integrators->add<StageIntegrator>("family", "the energy preserving and decaying schemes of this program");
      integrators->add<GeneralisedAlpha>("generalised alpha", "on the nodal frames, of index 3");
      integrators->add<TrapezoidalRule>("trapezoidal", "the trapezoidal rule, Newmark's method without dissipation");
      integrators->add<EnergyDecaying>("energy decaying", "the textbook scheme, in inertial velocities");
      integrators->add<BdfIndex2>("BDF index 2", "SUNDIALS' formulas of variable order and inner step, stabilised");
      integrators->add<BdfIndex1>("BDF index 1", "the same with constraints on accelerations");
      return integrators;
    }
  } // namespace



  Catalogue::Catalogue()
    : integrators(catalogue_of_integrators())
  {
    Registry<Item> layups, surfaces;
    layups.add<Layup>("layup", "plies one upon the other");
    surfaces.add<Surface>("lifting line", "wing or blade on a beam or a rigid body");
    Registry<Item> quantities;
    quantities.add<ProbeQuantity>("expression", "number that is made of probes, and is a probe itself");
    groups = {{"Materials", "material", catalogue_of_materials()},
              {"Layups", "layup", layups, "layup"},
              {"Sections", "section", catalogue_of_sections()},
              {"States", "state", catalogue_of_states(), "first order"},
              {"Bodies", "body", catalogue_of_bodies()},
              {"Joints", "joint", catalogue_of_joints()},
              {"Airfoils", "airfoil", catalogue_of_airfoils()},
              {"Aerodynamics", "air or inflow", catalogue_of_aerodynamics()},
              {"Surfaces", "surface", surfaces, "lifting line"},
              {"Loads", "load", catalogue_of_loads()}, // loads know what of the inertia has weight
              {"Quantities", "quantity", quantities, "expression"}};

    analyses.add<StaticAnalysis>("static", "equilibrium under loads and steady rotation");
    analyses.add<ModalAnalysis>("modal", "complex modes about the state reached");
    analyses.add<LinearSystemAnalysis>("linear system", "linear equations from controls to probes, for controllers");
    analyses.add<PeriodicLinearSystemAnalysis>("periodic linear system",
                                               "the same about a periodic motion, sampled, and its mean");
    analyses.add<DynamicAnalysis>("dynamic", "motion in time", integrators);
    analyses.add<TrimAnalysis>("trim", "controls for which a periodic motion meets its targets");
    analyses.add<FloquetAnalysis>("floquet", "stability of periodic motion");
    analyses.add<HarmonicsAnalysis>("harmonics",
                                    "harmonics of a periodic motion, loads of rotors in standing and turning axes");
    analyses.add<LyapunovAnalysis>("lyapunov", "growth of small changes of a motion that is not periodic");
    analyses.add<VerificationAnalysis>("verification",
                                       "derivatives, rigid motions and degree of the strains of elements");
    analyses.add<SectionReport>("section", "stiffness and centres of cross-sections, and stresses in them");
  }
} // namespace samara

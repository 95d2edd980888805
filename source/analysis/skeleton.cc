#include <samara/analysis/skeleton.h>
#include <samara/base/text.h>

namespace samara
{
  void
  MassReport::add_parameters(Parameters &prm)
  {
    prm.add("About", about, "Point about which the inertia is told, body.point; not given: the centre of mass.");
  }



  void
  MassReport::start(Context &)
  {
    // Before the first run of a sweep: nothing is left of what was done before.
    table.emplace(std::vector<std::string>{"speed [rad/s]",
                                           "mass [kg]",
                                           "x [m]",
                                           "y [m]",
                                           "z [m]",
                                           "J xx [kg m^2]",
                                           "J yy [kg m^2]",
                                           "J zz [kg m^2]",
                                           "J xy [kg m^2]",
                                           "J yz [kg m^2]",
                                           "J zx [kg m^2]"});
  }



  void
  MassReport::run(Context &context)
  {
    last = context.system.mass_properties(context.state);
    if (!about.empty())
      try
        {
          // Names are looked up here: a model is not complete while its file is read.
          const Frame   point = context.system.model.frame(about);
          const Vector3 d     = last.centre - point.position(context.state.q.data());
          last.inertia -= last.mass * skew(d) * skew(d); // Steiner
        }
      catch (const std::invalid_argument &problem)
        {
          throw InputError(parameters.where("About") + ": " + problem.what());
        }
    const Matrix3 &J = last.inertia;
    if (table)
      table->add_row({context.speeds.empty() ? 0. : context.speeds[0],
                      last.mass,
                      last.centre(0),
                      last.centre(1),
                      last.centre(2),
                      J(0, 0),
                      J(1, 1),
                      J(2, 2),
                      J(0, 1),
                      J(1, 2),
                      J(2, 0)});
    context.log.line("mass: " + number_to_text("%.6g", last.mass) + " kg");
  }



  void
  MassReport::finish(Context &context)
  {
    // Tests and automatic meshes have no folder.
    if (table && !context.folder.empty())
      table->write(context.folder + "/mass.csv");
  }
} // namespace samara

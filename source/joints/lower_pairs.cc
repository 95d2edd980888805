#include <samara/joints/lower_pairs.h>

namespace samara
{
  void
  Revolute::add_parameters(Parameters &prm)
  {
    for (const unsigned int i : {0, 1, 2})
      lock_displacement(i);
    lock_rotation(2, 0);
    lock_rotation(2, 1);
    free_rotation_about_3();
    Joint::add_parameters(prm);
    add_bearing_length(prm);
  }



  void
  Prismatic::add_parameters(Parameters &prm)
  {
    lock_displacement(0);
    lock_displacement(1);
    lock_rotation(2, 0);
    lock_rotation(2, 1);
    lock_rotation(0, 1);
    free_displacement(2);
    Joint::add_parameters(prm);
    add_bearing_length(prm);
  }



  void
  Screw::add_parameters(Parameters &prm)
  {
    lock_displacement(0);
    lock_displacement(1);
    lock_rotation(2, 0);
    lock_rotation(2, 1);
    free_displacement(2);
    free_rotation_about_3();
    is_screw = true;
    Joint::add_parameters(prm);
    prm.add("Pitch", pitch, "Displacement along axis 3 per rotation about it [m/rad].");
    thread.add_parameters(prm);
  }



  void
  Screw::initialize(Model &m)
  {
    Joint::initialize(m);
    thread.initialize(m, *this, parameters.subsection("thread"));
  }



  void
  Screw::connect(Layout &layout)
  {
    Joint::connect(layout);
    if (rows.empty())
      return; // it has complained
    thread.connect(layout, *this, used[0]->coordinate, used[1]->coordinate, first_multiplier + rows.size() - 1, pitch);
  }



  void
  Cylindrical::add_parameters(Parameters &prm)
  {
    lock_displacement(0);
    lock_displacement(1);
    lock_rotation(2, 0);
    lock_rotation(2, 1);
    free_displacement(2);
    free_rotation_about_3();
    Joint::add_parameters(prm);
    add_bearing_length(prm);
  }



  void
  RubbingJoint::initialize(Model &m)
  {
    Joint::initialize(m);
    std::vector<unsigned int> displacements;
    if (plane.is_given())
      for (const std::string motion : {"displacement 1", "displacement 2"})
        displacements.push_back(*use_coordinate(m, motion));
    if (plane.is_declared())
      plane.initialize(m, *this, parameters.subsection("displacement"), displacements);
    if (ball.is_declared())
      ball.initialize(m, *this, parameters.subsection("rotation"), {});
  }



  void
  RubbingJoint::connect(Layout &layout)
  {
    Joint::connect(layout);
    if (rows.empty())
      return; // it has complained
    std::vector<unsigned int> pressing;
    add_pressing(pressing);
    plane.connect(layout, *this, frame_a, frame_b, pressing);
    ball.connect(layout, *this, frame_a, frame_b, pressing);
  }



  void
  Planar::add_parameters(Parameters &prm)
  {
    lock_displacement(2);
    lock_rotation(2, 0);
    lock_rotation(2, 1);
    free_displacement(0, "displacement 1");
    free_displacement(1, "displacement 2");
    free_rotation_about_3();
    Joint::add_parameters(prm);
    plane.add_parameters(prm);
  }



  void
  Spherical::add_parameters(Parameters &prm)
  {
    for (const unsigned int i : {0, 1, 2})
      lock_displacement(i);
    Joint::add_parameters(prm);
    ball.add_parameters(prm);
  }
} // namespace samara

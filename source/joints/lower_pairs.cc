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
  }



  void
  Spherical::add_parameters(Parameters &prm)
  {
    for (const unsigned int i : {0, 1, 2})
      lock_displacement(i);
    Joint::add_parameters(prm);
  }
} // namespace samara

#include <samara/joints/skeleton.h>
#include <samara/model/drawing.h>

namespace samara
{
  void
  SlottedPin::add_parameters(Parameters &prm)
  {
    // Axes are counted from 0. First say what stays zero and what is free ...
    lock_displacement(1);
    lock_displacement(2);
    lock_rotation(2, 0);
    lock_rotation(2, 1);
    free_displacement(0);
    free_rotation_about_3();
    // ... then let the base bind its entries, those of the free motions among them, and add what is new. The unit in
    // the last brackets is the one in which a bare number is read.
    Joint::add_parameters(prm);
    prm.add("Length", length, "Length of the slot that is drawn [m].");
  }



  void
  SlottedPin::initialize(Model &model)
  {
    // What users can get wrong is a complaint at the line of the entry, not an exception: all are reported at once.
    if (length <= 0.)
      model.complaints.add(parameters.where("Length"), "joint <" + name + ">: the slot must have a length above zero");
    Joint::initialize(model);
  }



  void
  SlottedPin::draw(const State &state, Drawing &drawing) const
  {
    const Frame start = frame_a.then({-0.5 * length, 0, 0}), end = frame_a.then({0.5 * length, 0, 0});
    Joint::draw(state, drawing); // begins the object
    drawing.bar(drawing.sample(start, state), drawing.sample(end, state), 0.1 * draw_size);
  }
} // namespace samara

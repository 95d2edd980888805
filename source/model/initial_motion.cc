#include <samara/model/initial_motion.h>
#include <samara/model/system.h>

namespace samara
{
  bool
  add_initial_displacements(const System &system, State &state)
  {
    std::map<unsigned int, InitialMotion::Place> places;
    for (const auto &item : system.model.items)
      if (const auto *const motion = dynamic_cast<const InitialMotion *>(item.get()))
        motion->add_displacement_fields(state, places);
    for (const auto &[node, place] : places)
      {
        Eigen::Map<Vector3>(&state.q[12 * node])     = place.x;
        Eigen::Map<Matrix3>(&state.q[12 * node + 3]) = place.D;
      }
    if (!places.empty())
      system.update(state, std::vector<double>(system.size(), 0.)); // angles of joints follow
    return !places.empty();
  }
} // namespace samara

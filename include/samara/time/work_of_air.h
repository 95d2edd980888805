#ifndef samara_time_work_of_air_h
#define samara_time_work_of_air_h

#include <samara/model/load_of_air.h>
#include <samara/model/system.h>

#include <vector>

namespace samara
{
  /** What air does on a model, and two of the ways that what it takes goes: powers [W], or their work over a step [J].
   */
  struct WorkOfAir
  {
    double on_model = 0, induced = 0, profile = 0;

    void
    add(const double factor, const WorkOfAir &of)
    {
      on_model += factor * of.on_model;
      induced += factor * of.induced;
      profile += factor * of.profile;
    }
  };



  /** The loads of a system that are those of the air (LoadOfAir). */
  class AirOfSystem
  {
  public:
    explicit AirOfSystem(const System &system);

    bool
    is_empty() const
    {
      return loads.empty();
    }

    /** Powers at a point, nodal forces times nodal velocities. */
    WorkOfAir powers(const Point<double> &point) const;

  private:
    const System                  &system;
    std::vector<unsigned int>      loads; ///< numbers
    std::vector<const LoadOfAir *> items;
    mutable std::vector<double>    force; ///< work space
  };
} // namespace samara

#endif

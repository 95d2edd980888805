#ifndef samara_analysis_mode_names_h
#define samara_analysis_mode_names_h

#include <samara/analysis/blade_motion.h>
#include <samara/solvers/eigen.h>

#include <array>
#include <complex>
#include <string>

namespace samara
{
  /**
   * Names modes of a rotor by what its blades do, beams and shells alike: along the axis about which they turn (flap),
   * in its direction of turning (lag), about their own length (torsion), along it (stretch). A blade is a body that
   * turns and is longer away from its axis than across, by a factor of two. Slices across it move as rigid bodies; what
   * else its material does counts for no name.
   *
   * "flap 2" has two parts of alternating sign along the blade; "flap-lag" is told if no motion has 60 % of the kinetic
   * energy of the blades (in air: of what stands for it, Weighing), "local" if most of it is within the slices, nothing
   * if most is in what is no blade. (Of a periodic motion, with what blades do one behind the other: ContentOfModes.)
   */
  class ModeNames
  {
  public:
    /** @p turning: a state in steady rotation, at any speed. */
    ModeNames(const System &system, const State &turning);

    std::string of(const Mode &mode) const;

  private:
    using Complex                            = std::complex<double>;
    static constexpr unsigned int n_families = 4;

    struct Blade
    {
      Vector3                   along, circle, axis;
      std::vector<unsigned int> nodes;
      std::vector<unsigned int> slices; ///< of the nodes, from the axis outwards
      unsigned int              n_slices = 0;
    };
    /** Motion of slices, as rigid bodies, in each family, and their energies. */
    struct Content
    {
      std::vector<std::array<Complex, n_families>> motions;
      std::array<double, n_families>               energies{};
      double                                       total = 0; ///< with what moves within slices
    };

    const System             &system;
    const State               state;
    std::vector<Blade>        blades;
    std::vector<unsigned int> others; ///< nodes of no blade

    void    add_blade(const std::vector<unsigned int> &nodes);
    double  energy_of(const Mode &mode, const Weighing &weighing, const std::vector<unsigned int> &nodes) const;
    Content content_of(const Blade &blade, const Mode &mode, const Weighing &weighing) const;
    /** Motion of a slice of a blade as a rigid body in each family, and its mass in each. */
    struct Slice;
    Slice slice_of(const Blade &blade, unsigned int slice, const Eigen::VectorXcd &x) const;
  };
} // namespace samara

#endif

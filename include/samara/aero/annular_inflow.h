#ifndef samara_aero_annular_inflow_h
#define samara_aero_annular_inflow_h

#include <samara/aero/annular_momentum.h>
#include <samara/aero/inflow.h>

namespace samara
{
  /**
   * Inflow by blade elements and momentum, annulus by annulus, see AnnularMomentum: each station of the surfaces that
   * name it has two states of its own, the flow against the thrust axis and that against the azimuth. It does not
   * matter whether the hub turns.
   */
  class AnnularInflow : public Inflow
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    bool
    is_sum_of_shapes() const override
    {
      return false;
    }

    AnnularMomentum theory; ///< at t = 0

    /** The theory of a disk of this @p radius [m]. */
    AnnularMomentum
    within(const double radius) const
    {
      AnnularMomentum result = theory;
      result.radius          = radius;
      return result;
    }

    std::vector<Doubt> doubts(const State &state) const override;

    /** The states of a station at the radius @p r of the disk, for so much of its length [m]. */
    void add_station(unsigned int state, double r, double width);

    double initial = 0; ///< w of all stations [m/s]

  protected:
    /** w on the disk, all blades alike; the mean over the area that surfaces pass. */
    double mean(const State &state) const override;

  private:
    struct Annulus
    {
      unsigned int state;
      double       area;
    };
    std::vector<Annulus> annuli;
    std::string          tip_loss = "Prandtl", skew = "Pitt-Peters", ground_effect = "none";
  };
} // namespace samara

#endif

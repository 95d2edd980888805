#ifndef samara_cosserat_beamdyn_file_h
#define samara_cosserat_beamdyn_file_h

#include <samara/cosserat/section_stations.h>

#include <memory>

namespace samara
{
  /**
   * The properties along a blade of a blade file of BeamDyn (OpenFAST), which has its z along the blade: its x, y, z
   * are the axes 2, 3, 1 here, of stiffness, mass and damping alike. Places are relative to the length of the blade; a
   * file holds neither the length nor the twist, which are in the primary file of BeamDyn.
   *
   * Source: OpenFAST documentation, BeamDyn user manual, input files.
   */
  struct BeamDynBlade
  {
    struct Station
    {
      double  x = 0; ///< relative, from 0 to 1
      Matrix6 stiffness, inertia;
    };
    std::vector<Station> stations;

    /** Viscous stress is these times the rate of elastic stress, of Γ₁ Γ₂ Γ₃ K₁ K₂ K₃ [s]. */
    Vector6 damping = Vector6::Zero();

    /** With 15 digits. At two stations of one place there is a jump, which becomes a slope over 1e-6 of the blade. */
    std::string write(const std::string &title) const;

    /**
     * @param tolerance how far, relative to its largest moment of inertia, a mass matrix may be from one that bodies
     * have, [m I, −m c~; m c~, J] with c = (X, Y, 0) and J₁₁ = J₂₂ + J₃₃, that is I₄₄ + I₅₅ = I₆₆ in the axes of
     * BeamDyn
     * @throws std::invalid_argument saying file, line and what is wrong there
     */
    static BeamDynBlade read(const std::string &file, double tolerance);
  };



  /** Sections along a beam from a blade file of BeamDyn, with its damping; linear between stations, as there. */
  class BeamDynSection : public Section
  {
  public:
    void                         add_parameters(Parameters &prm) override;
    void                         initialize(Model &model) override;
    SectionValues                at(double x, const Vector3 &curvature) const override;
    SectionValues                at_side(double x, double inside, const Vector3 &curvature) const override;
    std::vector<Eigen::Vector2d> outline(double x) const override;
    std::vector<double>          kinks() const override;
    Vector6                      damping() const override;

  private:
    std::string                      file;
    double                           tolerance = 1e-3;
    BeamDynBlade                     blade;
    std::unique_ptr<SectionStations> stations;
  };
} // namespace samara

#endif

#ifndef samara_loads_surface_loads_h
#define samara_loads_surface_loads_h

#include <samara/loads/loads.h>
#include <samara/model/surface_load.h>

namespace samara
{
  /**
   * A force f and a moment m per area of the reference surface of a shell: dead loads, snow, thrust. The virtual work
   * is that of a line load with areas for lengths, see LineLoad, integrated by Gauss's rule with (p + 1)² points a
   * cell; followers have components along d₁ d₂ d₃ of the surface. What presses on the deformed area is a Pressure.
   */
  class AreaLoad : public WrenchLoad, public SurfaceLoad
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

    const SurfaceBody *
    loaded_body() const override
    {
      return loaded;
    }
    const std::string &
    loaded_region() const override
    {
      return region;
    }
    SurfaceTraction traction(const Point<double> &point) const override;

  private:
    std::string        body, region;
    const SurfaceBody *loaded = nullptr;
  };



  /**
   * Pressure p on the surface of a shell, positive along the normal d₃: a force p per deformed area, normal to the
   * deformed surface, on its reference surface. On node a, from points of weights w in the unit square,
   *
   *     f_a = Σ_g w_g p N_a (x,₁ × x,₂)
   *
   * It follows, so its tangent is not symmetric, and its work is counted as that of loads. It has no moment: an offset
   * of the laminate is neglected.
   */
  class Pressure : public Item, public Evaluated<Pressure, Force>, public SurfaceLoad
  {
  public:
    void   add_parameters(Parameters &prm) override;
    void   initialize(Model &model) override;
    void   find_signals(Model &model) override;
    void   connect(Layout &layout) override;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    void   pieces(const Point<double> &point, std::vector<double> &result) const override;
    double next_corner(double from, double to) const override;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    const SurfaceBody *
    loaded_body() const override
    {
      return loaded;
    }
    const std::string &
    loaded_region() const override
    {
      return region;
    }
    SurfaceTraction traction(const Point<double> &point) const override;

  private:
    std::string        body, region;
    const SurfaceBody *loaded = nullptr;
    Law                pressure;

    struct Cell
    {
      SurfaceCell               surface;
      Block                     block    = {};
      std::unique_ptr<Response> response = {}; ///< of a pressure that depends on the state
    };
    std::vector<Cell> cells;

    template <typename Number>
    Number value(const Point<Number> &point) const;

    /** The residual of a cell under the pressure @p p, 6 a frame. */
    template <typename Number>
    void local_residual(const Cell                               &cell,
                        const Number                             &p,
                        const Number                             *q,
                        Eigen::Matrix<Number, Eigen::Dynamic, 1> &r) const;

    /** What comes from the change of the pressure. */
    void add_responses(const Point<double> &point, bool by_velocity, SparseMatrix &A) const;
  };

  /** The body of that name as one with a surface. @throws std::invalid_argument if it is none. */
  const SurfaceBody &surface_body(const Model &model, const std::string &name);

  /**
   * The cells of a region of the body of that name, all of its cells if @p region is empty. If there is none, the entry
   * Body, or Region, is complained of.
   */
  std::vector<SurfaceCell>
  cells_of(Model &model, const Parameters &parameters, const std::string &body, const std::string &region);

  extern template class Evaluated<Pressure, Force>;
} // namespace samara

#endif

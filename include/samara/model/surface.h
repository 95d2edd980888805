#ifndef samara_model_surface_h
#define samara_model_surface_h

#include <samara/model/model.h>

#include <memory>
#include <string>
#include <vector>

namespace samara
{
  /** Shape functions of a quadrilateral at the points of a rule on the unit square, (point, node). */
  struct SurfaceRule
  {
    Eigen::MatrixXd N, dN_1, dN_2; ///< values and derivatives by the two unit coordinates
    Eigen::VectorXd weights;       ///< of the points; their sum is one
  };



  /** A quadrilateral of a surface: everything on it is a polynomial through its frames, whose third axes are normals.
   */
  struct SurfaceCell
  {
    std::vector<Frame>                 frames;
    std::shared_ptr<const SurfaceRule> rule;

    /** x,₁ × x,₂ at a point of the rule, for the positions of the frames: the normal times the area of the unit square.
     */
    template <typename Number>
    Vec3<Number>
    area_vector(const unsigned int point, const std::vector<Vec3<Number>> &x) const
    {
      Vec3<Number> x_1 = Vec3<Number>::Zero(), x_2 = Vec3<Number>::Zero();
      for (unsigned int a = 0; a < x.size(); ++a)
        {
          x_1 += rule->dN_1(point, a) * x[a];
          x_2 += rule->dN_2(point, a) * x[a];
        }
      return cross(x_1, x_2);
    }
  };



  /** What a body with a surface offers to loads and joints. */
  class SurfaceBody
  {
  public:
    virtual ~SurfaceBody() = default;

    /** The cells of a named region, all if it is "". @throws std::invalid_argument naming the regions there are. */
    virtual std::vector<SurfaceCell> surface(const std::string &region) const = 0;

    /**
     * A named edge, one span for each cell that has a side on it, one behind the other with abscissae that run on.
     * @throws std::invalid_argument naming the edges there are.
     */
    virtual std::vector<Span> edge(const std::string &name) const = 0;

    virtual double thickness() const = 0; ///< [m]

    /** The names of all edges. */
    virtual std::vector<std::string> edges() const = 0;

    /** A node of a region, and its share of the area [m^2]; the shares add up to the area of the region. */
    struct AreaShare
    {
      Frame  frame;
      double area;
    };
    /** @throws std::invalid_argument naming the regions there are. */
    virtual std::vector<AreaShare> region(const std::string &name) const = 0;

    /** The names of all regions. */
    virtual std::vector<std::string> regions() const = 0;
  };
} // namespace samara

#endif

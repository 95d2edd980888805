#include <samara/cosserat/mitc4_shell.h>

namespace samara
{
  namespace
  {
    /**
     * Shear d₃ · x,_β along the unit coordinate from node @p a to node @p b in the middle of this side: x is linear
     * there, and so are the triads.
     */
    template <typename Number>
    Number
    shear_of_side(const kernel::NodeValues<Number> &a, const kernel::NodeValues<Number> &b)
    {
      const Vec3<Number> along = b.x - a.x, normal = (a.D.col(2) + b.D.col(2)) * Number(0.5);
      return dot(normal, along);
    }
  } // namespace



  template <typename Number>
  void
  Mitc4Shell::strains_of(const PrototypeElement<2> &element, const kernel::NodeValues<Number> *nodes, Number *e) const
  {
    // nodes 0 1 2 3 at (0,0) (1,0) (0,1) (1,1)
    const Number along_1[] = {shear_of_side(nodes[0], nodes[1]), shear_of_side(nodes[2], nodes[3])};
    const Number along_2[] = {shear_of_side(nodes[0], nodes[2]), shear_of_side(nodes[1], nodes[3])};
    for (unsigned int g = 0; g < element.table.n_points; ++g)
      {
        const auto  &at      = element.table.points[g];
        const Number shear[] = {along_1[0] * (1 - at[1]) + along_1[1] * at[1],
                                along_2[0] * (1 - at[0]) + along_2[1] * at[0]};
        for (unsigned int alpha = 0; alpha < 2; ++alpha)
          {
            double shape[4], slope[4];
            for (unsigned int a = 0; a < 4; ++a)
              {
                shape[a] = element.value(g, a);
                slope[a] = element.slope(g, a, alpha);
              }
            const Vec6<Number> strain = kernel::strain(kernel::interpolate(nodes, 4, shape, slope));
            for (unsigned int k = 0; k < 6; ++k)
              e[12 * g + 6 * alpha + k] = strain(k);
            e[12 * g + 6 * alpha + 2] = shear[0] * element.T[g](alpha, 0) + shear[1] * element.T[g](alpha, 1);
          }
      }
  }



  template class Prototype<Mitc4Shell, Shell, 1>;
} // namespace samara

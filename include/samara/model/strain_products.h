#ifndef samara_model_strain_products_h
#define samara_model_strain_products_h

#include <samara/model/model.h>

#include <vector>

namespace samara
{
  /**
   * A strain that is not quadratic: ½ e_factor² + e_rest, of which both are. The stress of the factor is that of the
   * rest times e_factor. Steps take the rate e_factor ė_factor + ė_rest with the e_factor that the stages integrate,
   * which makes the strain at the end exact, and its energy (doc/theory/integrators.md).
   */
  struct StrainProduct
  {
    unsigned int factor, rest, result; ///< numbers among the strains of the model
  };

  /** An item that has such strains. */
  class HasStrainProducts
  {
  public:
    virtual ~HasStrainProducts() = default;

    /** Append them, once the item is connected. */
    virtual void add_strain_products(std::vector<StrainProduct> &products) const = 0;
  };

  /** Those of all items. */
  inline std::vector<StrainProduct>
  strain_products(const Model &model)
  {
    std::vector<StrainProduct> products;
    for (const auto &item : model.items)
      if (const auto *const has = dynamic_cast<const HasStrainProducts *>(item.get()))
        has->add_strain_products(products);
    return products;
  }
} // namespace samara

#endif

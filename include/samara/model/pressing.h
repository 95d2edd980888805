#ifndef samara_model_pressing_h
#define samara_model_pressing_h

#include <samara/model/layout.h>

#include <array>
#include <complex>

namespace samara
{
  /**
   * What of the reactions of a friction presses: N = Σ_p |A_p λ|, of the λ in Layout::Friction::multipliers, over the
   * places at which a force presses: A_p λ is the force there.
   */
  template <typename Number>
  struct PressingParts
  {
    static constexpr int most = 6; ///< multipliers
    using Part                = Eigen::Matrix<Number, 3, Eigen::Dynamic, 0, 3, most>;

    unsigned int        n = 0;
    std::array<Part, 2> of;

    /** The whole of them at one place, where there are three at most. */
    explicit PressingParts(const unsigned int n_multipliers)
    {
      add(n_multipliers).setIdentity();
    }
    PressingParts() = default;

    /** One more, zero. */
    Part &
    add(const unsigned int n_multipliers)
    {
      of[n].setZero(3, n_multipliers);
      return of[n++];
    }
  };



  /** What items have whose reactions do not press a friction as they are, all in one place. */
  class HasPressing
  {
  public:
    virtual ~HasPressing() = default;

    /** Whether the friction is pressed by reactions of this item, and not by all of them in one place. */
    virtual bool presses(const Layout::Friction &friction) const = 0;

    /** In what parts they do. @{ */
    virtual PressingParts<double>               pressing_parts(const Layout::Friction &friction,
                                                               const Point<double>    &point) const               = 0;
    virtual PressingParts<std::complex<double>> pressing_parts(const Layout::Friction            &friction,
                                                               const Point<std::complex<double>> &point) const = 0;
    /** @} */
  };



  /** The item, which adds the friction, if it says how that is pressed; nullptr: by its reactions as they are. */
  inline const HasPressing *
  pressing_by(const Item &item, const Layout::Friction &friction)
  {
    const auto *const pressing = friction.multipliers.empty() ? nullptr : dynamic_cast<const HasPressing *>(&item);
    return pressing != nullptr && pressing->presses(friction) ? pressing : nullptr;
  }



  /** The same of a layout whose items are all connected. */
  inline const HasPressing *
  pressing_of(const Layout &layout, const Layout::Friction &friction)
  {
    for (const auto &item : layout.model.items)
      if (const auto *const pressing = pressing_by(*item, friction))
        return pressing;
    return nullptr;
  }
} // namespace samara

#endif

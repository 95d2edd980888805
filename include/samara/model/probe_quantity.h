#ifndef samara_model_probe_quantity_h
#define samara_model_probe_quantity_h

#include <samara/model/item.h>

namespace samara
{
  /** A text that is read later, with the constants that its file knows. */
  struct UnreadExpression
  {
    std::string                       text;
    std::shared_ptr<const Quantities> quantities;
  };

  template <>
  struct Value<UnreadExpression>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = false;

    static UnreadExpression read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string
    write(const UnreadExpression &value)
    {
      return value.text;
    }

    static PatternPointer pattern();
  };



  /**
   * A number that is made of probes, and is a probe itself:
   *
   *     set Value = flow.thrust/(rho*sigma*pi*R^2*(Omega*R)^2)
   *
   * Dimensions are checked; angles are in rad inside. The result is in the unit that is asked for.
   */
  class ProbeQuantity : public Item
  {
  public:
    void                     add_parameters(Parameters &prm) override;
    void                     initialize(Model &model) override;
    void                     connect(Layout &layout) override;
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  private:
    UnreadExpression value;
    std::string      unit      = "1";
    Model           *model     = nullptr;
    mutable bool     is_in_use = false; ///< while it is read: a quantity of itself has no value

    /** @throws std::invalid_argument saying what cannot be read, FollowUp */
    Probe make() const;

    using ProbesInText = std::vector<std::pair<SignalNames::Found, Probe>>;

    /** The probes that the value names, and where. */
    ProbesInText find_probes() const;

    /** That of an @p object whose name stands in the value from @p begin on; where it ends, or @p begin: there is none.
     */
    std::size_t
    find_probe(const std::string &object, std::size_t begin, std::size_t after_object, ProbesInText &found) const;
  };
} // namespace samara

#endif

#ifndef samara_joints_contact_terms_h
#define samara_joints_contact_terms_h

#include <samara/model/layout.h>

#include <memory>
#include <vector>

namespace samara
{
  /**
   * The forces of contacts and of dry friction on joint coordinates, as terms of one item. They are for the state as it
   * is: in statics, in modes, in what is reported. In time steps the integrator takes Layout::stops and
   * Layout::frictions in their place (Point::stops is false).
   */
  class ContactTerms
  {
  public:
    /**
     * Add a contact of @p item, and its term if it is a load; returns its number in Layout::stops. To be called in
     * Item::connect().
     */
    unsigned int add_stop(Layout &layout, const Item &item, const Layout::Stop &stop);

    /** The same of friction, whose stop, if there is one, has been added. */
    void add_friction(Layout &layout, const Item &item, const Layout::Friction &friction);

    void
    clear()
    {
      terms.clear();
      equations.clear();
    }

  private:
    class Elastic;
    class Damper;
    class Friction;
    std::vector<std::unique_ptr<Force>>         terms;
    std::vector<std::unique_ptr<StateEquation>> equations; ///< of bristles

    void add(Layout &layout, const Item &item, std::unique_ptr<Force> term);
  };
} // namespace samara

#endif

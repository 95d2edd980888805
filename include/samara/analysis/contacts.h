#ifndef samara_analysis_contacts_h
#define samara_analysis_contacts_h

#include <samara/model/system.h>
#include <samara/time/integrator.h>

#include <map>
#include <string>
#include <vector>

namespace samara
{
  /**
   * Which stops of joints were touched when, for reports. Steps know nothing of it: times are roots of the polynomial
   * of the gap in a step that is done, as accurate as the step is.
   */
  class Contacts
  {
  public:
    /** From one touch of a stop until it is left. */
    struct Contact
    {
      unsigned int stop;           ///< number in Layout::stops
      double       onset;          ///< [s]
      double       release    = 0; ///< [s], when it is no longer touched
      bool         is_touched = true;
      double       depth      = 0; ///< the largest gap in the stages and at the ends of steps [m] or [rad]
      double       loss       = 0; ///< of the stop's damper [J]
    };

    /** Contacts in the order of steps. */
    const std::vector<Contact> &
    all() const
    {
      return contacts;
    }

    /** Add what the step between two times [s] did. */
    void add(const StepResult &step, double from, double to);

    /** As numbers in a checkpoint, and from there. @{ */
    std::vector<double> to_numbers() const;
    void                set_numbers(const std::vector<double> &numbers);
    /** @} */

    /** Write the table of all contacts in the order of their onsets. @throws CannotWrite */
    void write(const std::string &file, const Layout &layout) const;

    /** A line a stop that was touched: how often, when first, and the largest depth. */
    std::string summary(const Layout &layout) const;

    /** Of Layout::frictions: how far slips have gone that were so slow that they should stick [m]. */
    std::vector<double> creep;

    /** A line for each that did; empty if there is none. */
    std::string creep_summary(const Layout &layout) const;

  private:
    std::vector<Contact>                contacts;
    std::map<unsigned int, std::size_t> open; ///< those that are not over, by their stops

    void begin(unsigned int stop, double time);
    void end(unsigned int stop, double time);
  };
} // namespace samara

#endif

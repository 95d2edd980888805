#ifndef samara_time_integrators_h
#define samara_time_integrators_h

#include <samara/base/registry.h>
#include <samara/time/integrator.h>

namespace samara
{
  /** All kinds of integrators, under the names by which .prm files call them. */
  class Integrators
  {
  public:
    using Factory = std::function<std::unique_ptr<Integrator>(const System &, const IntegratorSettings &)>;

    /** Add the class @p T, which is made of a system and settings, and says by T::abilities what it can do. */
    template <typename T>
    void
    add(const std::string &name, const std::string &what_it_is)
    {
      const Factory factory = [](const System &system, const IntegratorSettings &settings) {
        return std::make_unique<T>(system, settings);
      };
      kinds.add<Kind>(name, what_it_is, Kind{factory, T::abilities});
    }

    /**
     * The integrator of this name.
     * @throws InputError for a name that is not among them, std::invalid_argument if it cannot do what the system
     * needs.
     */
    std::unique_ptr<Integrator>
    make(const std::string &name, const System &system, const IntegratorSettings &settings) const;

    /** @throws InputError for a name that is not among them */
    IntegratorAbilities abilities_of(const std::string &name) const;

    std::vector<std::string>
    names() const
    {
      return kinds.kinds();
    }

    /** "family: schemes of this program; trapezoidal: ...", for the documentation of an entry. */
    std::string what_they_are() const;

  private:
    struct Kind
    {
      Factory             make;
      IntegratorAbilities abilities;
    };
    Registry<Kind> kinds;

    /** Names of those that can do something, "<family>", for messages. */
    std::string that_know(bool IntegratorAbilities::*ability) const;
  };
} // namespace samara

#endif

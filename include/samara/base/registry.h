#ifndef samara_base_registry_h
#define samara_base_registry_h

#include <samara/base/errors.h>
#include <samara/base/text.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace samara
{
  /**
   * All kinds of one thing (body, joint, load, ...) under the names by which .prm files call them, in the order in
   * which they were added.
   *
   * An ordinary object which the catalogue fills. Registration by static objects would be shorter to write, but a
   * linker drops it without a word from code in a library.
   */
  template <typename Interface>
  class Registry
  {
  public:
    using Factory = std::function<std::unique_ptr<Interface>()>;

    /** Add a kind. @p what_it_is is one sentence for --help. */
    void
    add(const std::string &kind, const std::string &what_it_is, const Factory &factory)
    {
      AssertThrow(!contains(kind), dealii::ExcMessage("The kind <" + kind + "> is registered twice."));
      AssertThrow(factory != nullptr, dealii::ExcMessage("The kind <" + kind + "> has no factory."));
      items.push_back({kind, what_it_is, factory});
    }

    /** Add the class @p T; each is made of copies of the @p arguments, as a shared pointer to what it has to know. */
    template <typename T, typename... Arguments>
    void
    add(const std::string &kind, const std::string &what_it_is, const Arguments &...arguments)
    {
      add(kind, what_it_is, Factory([=]() { return std::make_unique<T>(arguments...); }));
    }

    bool
    contains(const std::string &kind) const
    {
      return find(kind) != items.end();
    }

    /** Construct one. Throws an InputError that says what is known if there is no such kind. */
    std::unique_ptr<Interface>
    make(const std::string &kind, const std::string &where = "") const
    {
      return existing(kind, where)->factory();
    }

    /** The sentence given to add(). */
    const std::string &
    what_it_is(const std::string &kind) const
    {
      return existing(kind, "")->what;
    }

    std::vector<std::string>
    kinds() const
    {
      std::vector<std::string> names;
      for (const auto &item : items)
        names.push_back(item.kind);
      return names;
    }

  private:
    struct Item
    {
      std::string kind, what;
      Factory     factory;
    };

    typename std::vector<Item>::const_iterator
    find(const std::string &kind) const
    {
      return std::find_if(items.begin(), items.end(), [&](const Item &item) { return item.kind == kind; });
    }

    typename std::vector<Item>::const_iterator
    existing(const std::string &kind, const std::string &where) const
    {
      const auto item = find(kind);
      if (item == items.end())
        throw InputError((where.empty() ? "" : where + ": ") + "there is no kind <" + kind + ">" +
                         did_you_mean(kind, kinds()));
      return item;
    }

    std::vector<Item> items;
  };
} // namespace samara

#endif

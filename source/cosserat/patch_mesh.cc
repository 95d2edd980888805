#include <samara/cosserat/patch_mesh.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace samara
{
  namespace
  {
    constexpr unsigned int most_along_a_patch = 2000;



    PatchElements
    read_patch_elements(const std::string &text, const Quantities &quantities)
    {
      const auto words = split_top_level(text, ',');
      if (words.size() != 2)
        throw std::invalid_argument("<" + text + ">: write two numbers of elements, along u and along v: 4, 8");
      const PatchElements result{Value<unsigned int>::read(words[0], "", quantities),
                                 Value<unsigned int>::read(words[1], "", quantities)};
      for (const unsigned int n : {result.u, result.v})
        if (n == 0 || n > most_along_a_patch)
          throw std::invalid_argument("<" + text + ">: a patch has 1 to 2000 elements along u and along v");
      return result;
    }



    std::vector<double>
    numbers_of(const std::string &text)
    {
      std::vector<double> numbers;
      std::istringstream  words(text);
      double              number = 0;
      for (std::string word; words >> word;)
        if (text_to_number(word, number))
          numbers.push_back(number);
        else
          throw std::invalid_argument("<" + word + "> is no number where an element ends");
      return numbers;
    }
  } // namespace



  Division::Division(const unsigned int n)
  {
    for (unsigned int i = 0; i < n; ++i)
      ends.push_back((i + 1.) / n);
  }



  Division::Division(const std::vector<double> &ends_)
    : ends(ends_)
  {
    if (ends.empty() || std::abs(ends.back() - 1) > 1e-9)
      throw std::invalid_argument("the last element ends at 1");
    if (ends.size() > most_along_a_patch)
      throw std::invalid_argument("a patch has at most 2000 elements along u and along v");
    ends.back() = 1;
    for (unsigned int i = 0; i < ends.size(); ++i)
      if (!(length(i) > 1e-9))
        throw std::invalid_argument("an element ends beyond the one before it, not at " + number_to_text(ends[i]));
  }



  unsigned int
  Division::piece(const double x, const double rounding) const
  {
    unsigned int i = 0;
    while (i + 1 < ends.size() && x >= ends[i] - rounding * length(i))
      ++i;
    return i;
  }



  Division
  Division::halved(const std::vector<bool> &pieces) const
  {
    std::vector<double> result;
    for (unsigned int i = 0; i < ends.size(); ++i)
      {
        if (pieces[i])
          result.push_back(at(i, 0.5));
        result.push_back(ends[i]);
      }
    return Division(result);
  }



  void
  Division::add(const double end)
  {
    const unsigned int i = piece(end);
    if (std::min(std::abs(end - start(i)), std::abs(end - ends[i])) > 1e-6)
      ends.insert(ends.begin() + i, end);
  }



  PatchMesh
  Value<PatchMesh>::read(const std::string &text, const std::string &, const Quantities &)
  {
    const auto by = text.find(" by ");
    if (by == std::string::npos)
      throw std::invalid_argument("<" + text + ">: write where elements end along u, and along v: 0.25 0.5 1 by 0.5 1");
    try
      {
        return {Division(numbers_of(text.substr(0, by))), Division(numbers_of(text.substr(by + 4)))};
      }
    catch (const std::invalid_argument &problem)
      {
        throw std::invalid_argument("<" + text + ">: " + problem.what());
      }
  }



  std::string
  Value<PatchMesh>::write(const PatchMesh &value)
  {
    std::string text;
    for (const auto *const division : {&value.u, &value.v})
      {
        text += text.empty() ? "" : "by ";
        for (const double end : division->all())
          text += number_to_text(end) + " ";
      }
    text.pop_back();
    return text;
  }



  PatternPointer
  Value<PatchMesh>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  ShellElements
  Value<ShellElements>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    ShellElements     result;
    std::string       counts    = text;
    const std::string automatic = "automatic";
    if (trim(text).compare(0, automatic.size(), automatic) == 0)
      {
        const auto from  = text.find(" from ");
        const auto words = split_top_level(text.substr(0, from), ',');
        result.error     = words.size() == 2 && trim(words[0]) == automatic ? quantities.number(words[1], "") : 0.;
        if (!(result.error > 0) || result.error >= 1)
          throw std::invalid_argument("<" + text +
                                      ">: write <automatic, 1e-2>, with the relative error of the strains.");
        if (from == std::string::npos)
          return result;
        counts = text.substr(from + 6);
      }
    result.counts.clear();
    for (const auto &of_patch : split_top_level(counts, ';'))
      result.counts.push_back(read_patch_elements(of_patch, quantities));
    if (result.counts.empty())
      throw std::invalid_argument("a value is missing.");
    return result;
  }



  std::string
  Value<ShellElements>::write(const ShellElements &value)
  {
    std::string text;
    for (const auto &count : value.counts)
      text += (text.empty() ? "" : "; ") + std::to_string(count.u) + ", " + std::to_string(count.v);
    return value.error > 0 ? "automatic, " + number_to_text(value.error) + " from " + text : text;
  }



  PatternPointer
  Value<ShellElements>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }
} // namespace samara

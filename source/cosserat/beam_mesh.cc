#include <samara/cosserat/beam_mesh.h>

#include <cmath>

namespace samara
{
  ElementsWish
  Value<ElementsWish>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    ElementsWish wish;
    const auto   words = split_top_level(text, ',');
    if (words.empty())
      throw std::invalid_argument("a value is missing.");
    if (words[0] != "automatic")
      {
        wish.number = Value<unsigned int>::read(text, "", quantities);
        if (wish.number == 0)
          throw std::invalid_argument("<" + text + ">: a beam has at least one element.");
        if (wish.number > most_elements_of_beam)
          throw std::invalid_argument("<" + text + ">: a beam has at most " + std::to_string(most_elements_of_beam) +
                                      " elements.");
        return wish;
      }
    wish.error = words.size() == 2 ? quantities.number(words[1], "") : 0.;
    if (!(wish.error > 0) || wish.error >= 1)
      throw std::invalid_argument("<" + text + ">: write <automatic, 1e-4>, with the relative error of the strains.");
    return wish;
  }



  std::string
  Value<ElementsWish>::write(const ElementsWish &wish)
  {
    return wish.error > 0 ? "automatic, " + number_to_text(wish.error) : std::to_string(wish.number);
  }



  PatternPointer
  Value<ElementsWish>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  std::vector<MeshElement>
  read_mesh(const std::vector<std::string> &texts)
  {
    std::vector<MeshElement> mesh;
    for (const auto &text : texts)
      {
        const auto  to = text.find(" to ");
        MeshElement element{0, 0};
        double      degree = 0;
        if (to == std::string::npos || !text_to_number(trim(text.substr(0, to)), degree) ||
            !text_to_number(trim(text.substr(to + 4)), element.end) || degree != std::round(degree) || degree < 1 ||
            degree > highest_beam_degree)
          throw std::invalid_argument(
            "an element of a mesh is written <3 to 0.25>, its degree from 1 to 6 and where it ends, "
            "not <" +
            text + ">");
        element.degree = static_cast<unsigned int>(degree);
        if (!(element.end > (mesh.empty() ? 0. : mesh.back().end) + 1e-9))
          throw std::invalid_argument("<" + text + ">: an element ends beyond the one before it");
        mesh.push_back(element);
      }
    if (!mesh.empty() && std::abs(mesh.back().end - 1) > 1e-9)
      throw std::invalid_argument("the last element of a mesh ends at 1, not at " + number_to_text(mesh.back().end));
    return mesh;
  }



  std::string
  mesh_to_text(const std::vector<MeshElement> &mesh)
  {
    std::vector<std::string> texts;
    for (const auto &element : mesh)
      texts.push_back(std::to_string(element.degree) + " to " + number_to_text(element.end));
    return join(texts, ", ");
  }
} // namespace samara

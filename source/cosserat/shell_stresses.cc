// Stresses of the layers of a shell: at a node, over the surface, in pictures.

#include <samara/base/text.h>
#include <samara/cosserat/shell.h>
#include <samara/section/extremes_by_name.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  Shell::PlateState
  Shell::plate_state(const Recovered &s, const unsigned int laminate) const
  {
    // what drilling adds is of opposite sign in the two shear forces, and what it adds to the moments in K₁₁ and K₂₂
    Vector6 forces;
    forces << s(0), 0.5 * (s(1) + s(6)), s(7), s(4), 0.5 * (s(10) - s(3)), -s(9);
    forces.tail<3>() -= offset * forces.head<3>(); // about the middle of the thickness
    PlateState result{laminate, compliances[laminate] * forces, {s(2), s(8)}, {}};
    if (knows_across())
      {
        result.across = {Eigen::Map<const Eigen::Matrix2d>(&s(row_of_gradient)),
                         s.segment<3>(row_of_curvature),
                         s(row_of_bottom),
                         s(row_of_top),
                         s(row_of_inertia)};
        result.across.balance(forces.head<3>());
      }
    return result;
  }



  Vector6
  Shell::layer_stress(const PlateState &at, const unsigned int layer, const double z) const
  {
    const Laminate &laminate = laminates[at.laminate];
    Vector6         stress   = laminate.stress(layer, z, at.strains, at.shear);
    if (knows_across())
      stress(2) = laminate.stress_across(layer, z, at.strains, at.across);
    return laminate.stress_in_material(layer, stress);
  }



  SectionStresses::Extremes
  Shell::layer_extremes(const PlateState &at, const int layer) const
  {
    SectionStresses::Extremes result;
    const Laminate           &laminate = laminates[at.laminate];
    const int                 n_layers = strengths[at.laminate].size();
    for (int k = std::max(layer, 0); k < (layer < 0 ? n_layers : std::min(layer + 1, n_layers)); ++k)
      {
        const auto [bottom, top] = laminate.heights(k);
        // in-plane stresses are linear in z, and largest at an end; those across are of second and third degree
        for (const double z : {bottom, 0.5 * (bottom + top), top})
          result.add(strengths[at.laminate][k], layer_stress(at, k, z));
      }
    return result;
  }



  Shell::VectorN
  Shell::stress_at_node(const unsigned int element, const unsigned int a, const State &state) const
  {
    VectorN stress = VectorN::Zero();
    for (unsigned int g = 0; g < table->n_points; ++g)
      stress += to_nodes(a, g) *
                Eigen::Map<const VectorN>(&state.stress[first_strain + n * (elements[element].first_point + g)]);
    return stress;
  }



  unsigned int
  Shell::laminate_at(const unsigned int node) const
  {
    int found = -1;
    for (unsigned int i = 0; laminates.size() > 1 && i < mesh->cells.size(); ++i)
      if (const auto &nodes = mesh->cells[i].nodes; std::find(nodes.begin(), nodes.end(), node) != nodes.end())
        {
          const int here = laminate_of(i);
          if (found >= 0 && here != found)
            throw std::invalid_argument("patches or regions with layups of their own meet there in shell <" + name +
                                        ">: ask for stresses inside of one of them, or over the surface, <layers>");
          found = here;
        }
    return std::max(found, 0);
  }



  int
  Shell::layer_named(const std::string &name_of_layer) const
  {
    std::size_t n_layers = 0;
    for (const auto &of_laminate : strengths)
      n_layers = std::max(n_layers, of_laminate.size());
    const std::string first = "layer ";
    if (name_of_layer == "layers")
      return -1;
    double number = 0;
    if (name_of_layer.substr(0, first.size()) != first || !text_to_number(name_of_layer.substr(first.size()), number) ||
        !(number >= 1) || number > static_cast<double>(n_layers) || number != std::floor(number))
      throw std::invalid_argument("shell <" + name + "> has " +
                                  (n_layers == 1 ? std::string("one layer, <layer 1>") :
                                                   std::to_string(n_layers) +
                                                     " layers, <layer 1> the one at the bottom, or all of them, "
                                                     "<layers>") +
                                  "; there is no <" + name_of_layer + ">");
    return static_cast<int>(number) - 1;
  }



  std::optional<Probe>
  Shell::layer_probe(const std::string &path, const std::string &point, const std::string &text) const
  {
    // "layers.Hashin index" over the surface; "tip.layer 2.stress 11" or "tip.stress 11" at a node
    const auto          dot   = point.rfind('.');
    const std::string   last  = trim(dot == std::string::npos ? point : point.substr(dot + 1));
    const bool          names = last == "layers" || last.substr(0, 6) == "layer ";
    const std::string   place = names ? (dot == std::string::npos ? "" : trim(point.substr(0, dot))) : point;
    // "layers.stress 11 error": how well it is known
    const std::string   ending   = " error";
    const bool          of_error = text.size() > ending.size() && text.substr(text.size() - ending.size()) == ending;
    const ExtremeByName quantity(of_error ? text.substr(0, text.size() - ending.size()) : text);
    if (!quantity.is_known() || (!names && !is_place(place)))
      return {};
    if (rigid)
      throw std::invalid_argument("shell <" + name + "> is rigid: nothing is known of its stresses");
    if (text.find(across_the_layers) == 0 && !knows_across())
      throw std::invalid_argument("the stress 33 of shell <" + name +
                                  "> is not known: it takes elements of type <shell> of degree 2 or more");
    const int  layer             = names ? layer_named(last) : -1;
    const auto require_strengths = [&](const unsigned int laminate) {
      if (!place.empty() && layer >= static_cast<int>(strengths[laminate].size()))
        throw std::invalid_argument("there are " + std::to_string(strengths[laminate].size()) + " layers at <" + place +
                                    "> of shell <" + name + ">");
      for (int k = 0; k < static_cast<int>(strengths[laminate].size()); ++k)
        if (SectionStresses::Extremes none; layer < 0 || layer == k)
          {
            none.add(strengths[laminate][k], Vector6::Zero());
            if (quantity.of(none) < 0)
              throw std::invalid_argument("<" + path + "> needs more strengths of the material of layer " +
                                          std::to_string(k + 1) + " of shell <" + name + ">");
          }
    };
    for (unsigned int laminate = 0; place.empty() && laminate < laminates.size(); ++laminate)
      require_strengths(laminate);
    are_stresses_asked = true;
    if (place.empty())
      return Probe{path, quantity.unit(), [=](const State &state) {
                     const Peak peak = peak_over_surface(quantity, layer, state);
                     return of_error ? peak.error : peak.value;
                   }};
    if (of_error)
      throw std::invalid_argument("<" + path + ">: how well it is known is told of the largest over the surface, <" +
                                  name + "." + (names ? last : "layers") + "." + text + ">");
    const int node = point_named(place).node;
    if (node < 0)
      throw std::invalid_argument("shell <" + name + "> has no stresses at <" + place + ">, which is no node of it");
    const unsigned int laminate = laminate_at(node);
    require_strengths(laminate);
    return Probe{path, quantity.unit(), [=](const State &state) {
                   return quantity.of(layer_extremes(plate_state(mean_recovered(node, state), laminate), layer));
                 }};
  }



  Shell::WorstLayer
  Shell::worst_layer(const PlateState &at) const
  {
    WorstLayer                result;
    SectionStresses::Extremes all;
    for (unsigned int l = 0; l < strengths[at.laminate].size(); ++l)
      {
        const SectionStresses::Extremes of_layer = layer_extremes(at, l);
        all.add(of_layer);
        if (const double here = of_layer.indices.largest(); here > result.index)
          {
            result.index = here;
            result.layer = l;
          }
      }
    result.von_mises = all.von_mises_stress;
    return result;
  }



  void
  Shell::draw_worst_layers(const std::vector<PlateState> &states,
                           const std::vector<PlateState>  with_less[2],
                           const unsigned int             first_sample,
                           Drawing                       &drawing) const
  {
    Field &strain    = drawing.field("membrane strain", "1", {"11", "22", "12"});
    Field &curvature = drawing.field("bending curvature", "1/m", {"11", "22", "12"});
    Field &von_mises = drawing.field("von Mises stress", "Pa");
    Field &error     = drawing.field("von Mises stress error", "Pa");
    for (unsigned int k = 0; k < states.size(); ++k)
      {
        const PlateState &at    = states[k];
        const WorstLayer  worst = worst_layer(at), less = worst_layer(with_less[0][k]),
                         least = worst_layer(with_less[1][k]);
        const auto in_order    = [&](const int first) {
          return std::array<double, 3>{{at.strains(first), at.strains(first + 2), at.strains(first + 1)}};
        };
        strain.set(first_sample + k, in_order(0));
        curvature.set(first_sample + k, in_order(3));
        von_mises.set(first_sample + k, worst.von_mises);
        error.set(first_sample + k, next_term(worst.von_mises, less.von_mises, least.von_mises));
        if (worst.layer < 0)
          continue; // no strengths are known
        drawing.field("index of failure", "1").set(first_sample + k, worst.index);
        drawing.field("index of failure error", "1")
          .set(first_sample + k, next_term(worst.index, std::max(0., less.index), std::max(0., least.index)));
        drawing.field("layer nearest to failure", "1").set(first_sample + k, worst.layer + 1);
      }
  }



  namespace
  {
    /** Fields of the layers, by the names of the probes; an index is left out where it is not known. */
    class LayerFields
    {
    public:
      LayerFields(Drawing &drawing, const std::string &left_out)
        : drawing(drawing)
        , layer(drawing.field("layer", "1"))
        , in_layer(drawing.field("height in layer", "1"))
        , height(drawing.field("height", "m"))
        , worst(nullptr)
      {
        for (const auto &name : ExtremeByName::names())
          if (name != left_out)
            quantities.push_back({name, ExtremeByName(name), nullptr});
      }

      void
      set_place(const unsigned int sample, const unsigned int number, const int side, const double z)
      {
        layer.set(sample, number);
        in_layer.set(sample, side);
        height.set(sample, z);
      }

      void
      set(const unsigned int sample, const SectionStresses::Extremes &at)
      {
        for (auto &[name, quantity, field] : quantities)
          set(sample, quantity.of(at), quantity.unit() == "1" && quantity.of(at) < 0, name, quantity.unit(), field);
        set(sample, at.indices.largest(), at.indices.largest() < 0, "index of failure", "1", worst);
      }

    private:
      struct Quantity
      {
        std::string   name;
        ExtremeByName quantity;
        Field        *field;
      };

      Drawing              &drawing;
      Field                &layer, &in_layer, &height;
      Field                *worst;
      std::vector<Quantity> quantities;

      void
      set(const unsigned int sample,
          const double       value,
          const bool         is_unknown,
          const std::string &name,
          const std::string &unit,
          Field            *&field)
      {
        if (is_unknown)
          return;
        if (field == nullptr)
          field = &drawing.field(name, unit);
        field->set(sample, value);
      }
    };
  } // namespace



  void
  Shell::draw_layers(const std::vector<unsigned int> &order, const State &state, Drawing &drawing) const
  {
    if (n_elements() == 0)
      return; // rigid
    drawing.begin_object(name + " layers");
    LayerFields             fields(drawing, knows_across() ? "" : across_the_layers);
    std::vector<Sample>     samples(order.size());
    std::vector<PlateState> states(order.size());
    for (unsigned int i = 0; i < n_elements(); ++i)
      {
        const Laminate       &laminate = laminates[laminate_of(i)];
        if (drawing.has_fields())
          {
            const Eigen::MatrixXd at_nodes = recovered_at_nodes(i, state);
            for (unsigned int k = 0; k < order.size(); ++k)
              states[k] = plate_state(at_nodes.col(order[k]), laminate_of(i));
          }
        for (unsigned int l = 0; l < strengths[laminate_of(i)].size(); ++l)
          for (int side = -1; side <= 1; ++side)
            {
              const auto [bottom, top] = laminate.heights(l);
              const double z           = side < 0 ? bottom : side > 0 ? top : 0.5 * (bottom + top);
              for (unsigned int k = 0; k < order.size(); ++k)
                {
                  Frame at = elements[i].frames[order[k]];
                  at.arm += (offset + z) * at.rotation.col(2); // along the normal
                  samples[k] = drawing.sample(at, state);
                }
              const unsigned int first = drawing.grid(degree + 1, degree + 1, samples).first_sample;
              for (unsigned int k = 0; k < order.size() && drawing.has_fields(); ++k)
                {
                  SectionStresses::Extremes there;
                  there.add(strengths[laminate_of(i)][l], layer_stress(states[k], l, z));
                  fields.set_place(first + k, l + 1, side, offset + z);
                  fields.set(first + k, there);
                }
            }
      }
  }
} // namespace samara

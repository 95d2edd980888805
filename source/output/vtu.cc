#include <samara/output/vtu.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** VTK's numbers for a point, a line, and a quadrilateral whose corners go round it. */
    constexpr std::uint8_t vtk_kinds[] = {1, 3, 9};



    void
    add_base64(const unsigned char *bytes, const std::size_t n, std::string &text)
    {
      static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      for (std::size_t i = 0; i < n; i += 3)
        {
          const unsigned int in_group = n - i < 3 ? n - i : 3;
          std::uint32_t      group    = 0;
          for (unsigned int k = 0; k < 3; ++k)
            group = group << 8 | (k < in_group ? bytes[i + k] : 0u);
          for (unsigned int k = 0; k < 4; ++k)
            text += k <= in_group ? letters[group >> (18 - 6 * k) & 63] : '=';
        }
    }



    /** The numbers as one block of zlib, after a header: blocks, size, size of a last partial block, compressed size.
     */
    void
    add_numbers(const void *numbers, const std::size_t n_bytes, Compressor &compressor, std::string &text)
    {
      const std::vector<unsigned char> &compressed = compressor(numbers, n_bytes);
      const std::uint32_t               header[4]  = {1u,
                                                      static_cast<std::uint32_t>(n_bytes),
                                                      static_cast<std::uint32_t>(n_bytes),
                                                      static_cast<std::uint32_t>(compressed.size())};
      add_base64(reinterpret_cast<const unsigned char *>(header), sizeof header, text);
      add_base64(compressed.data(), compressed.size(), text);
    }



    template <typename Number>
    void
    add_array(const std::string         &attributes,
              const std::vector<Number> &numbers,
              Compressor                &compressor,
              std::string               &text)
    {
      text += "    <DataArray " + attributes + " format=\"binary\">\n";
      if (!numbers.empty())
        add_numbers(numbers.data(), numbers.size() * sizeof(Number), compressor, text);
      text += "\n    </DataArray>\n";
    }



    void
    add_cells(const Drawing &drawing, Compressor &compressor, std::string &text)
    {
      std::vector<std::int32_t> connectivity, offsets;
      std::vector<std::uint8_t> kinds;
      for (const auto &cell : drawing.cells)
        {
          connectivity.insert(connectivity.end(), cell.corners.begin(), cell.corners.begin() + cell.n_corners());
          offsets.push_back(connectivity.size());
          kinds.push_back(vtk_kinds[cell.dimension]);
        }
      text += "  <Cells>\n";
      add_array("type=\"Int32\" Name=\"connectivity\"", connectivity, compressor, text);
      add_array("type=\"Int32\" Name=\"offsets\"", offsets, compressor, text);
      add_array("type=\"UInt8\" Name=\"types\"", kinds, compressor, text);
      text += "  </Cells>\n";
    }



    /** An array with the values of a field, value(i, component) for i < n. */
    template <typename Value>
    void
    add_field(const std::string              &name,
              const std::string              &unit,
              const std::vector<std::string> &components,
              const std::size_t               n,
              const Value                    &value,
              Compressor                     &compressor,
              std::string                    &text)
    {
      std::string attributes = "type=\"Float32\" Name=\"" + name + '"';
      if (!components.empty())
        attributes += " NumberOfComponents=\"" + std::to_string(components.size()) + '"';
      for (std::size_t d = 0; d < components.size(); ++d)
        attributes += " ComponentName" + std::to_string(d) + "=\"" + components[d] + '"';
      if (!unit.empty())
        attributes += " units=\"" + unit + '"';
      const std::size_t  n_components = std::max<std::size_t>(components.size(), 1);
      std::vector<float> numbers(n_components * n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t d = 0; d < n_components; ++d)
          numbers[n_components * i + d] = value(i, d);
      add_array(attributes, numbers, compressor, text);
    }



    void
    add_point_data(const Drawing &drawing, Compressor &compressor, std::string &text)
    {
      const std::size_t n          = drawing.corners.size();
      const auto        of_sample  = [&](const std::size_t i) { return drawing.corners[i].sample; };
      const auto        add_vector = [&](const char *name, const char *unit, Vector3 Sample::*vector) {
        const auto value = [&](const std::size_t i, const std::size_t d) -> float {
          return (drawing.samples[of_sample(i)].*vector)(d);
        };
        add_field(name, unit, inertial_axes, n, value, compressor, text);
      };
      text += "  <PointData>\n";
      add_vector("displacement", "m", &Sample::displacement);
      add_vector("velocity", "m/s", &Sample::velocity);
      for (const Field &field : drawing.fields)
        if (!field.is_on_cells)
          {
            AssertThrow(field.end() <= drawing.samples.size(),
                        dealii::ExcMessage("<" + field.name + "> has too many samples."));
            const auto value = [&](const std::size_t i, const std::size_t d) { return field(of_sample(i), d); };
            add_field(field.name, field.unit, field.components, n, value, compressor, text);
          }
      const auto object = [&](const std::size_t i, std::size_t) -> float { return drawing.corners[i].object; };
      add_field("object", "", {}, n, object, compressor, text);
      text += "  </PointData>\n";
    }



    void
    add_cell_data(const Drawing &drawing, Compressor &compressor, std::string &text)
    {
      text += "  <CellData>\n";
      for (const Field &field : drawing.fields)
        if (field.is_on_cells)
          {
            AssertThrow(field.end() <= drawing.cells.size(),
                        dealii::ExcMessage("<" + field.name + "> has too many cells."));
            add_field(field.name, field.unit, field.components, drawing.cells.size(), field, compressor, text);
          }
      text += "  </CellData>\n";
    }
  } // namespace



  Compressor::Compressor()
  {
    if (deflateInit(&stream, Z_BEST_SPEED) != Z_OK)
      throw std::runtime_error("no memory to compress pictures");
  }



  Compressor::~Compressor()
  {
    deflateEnd(&stream);
  }



  const std::vector<unsigned char> &
  Compressor::operator()(const void *bytes, const std::size_t n_bytes)
  {
    deflateReset(&stream);
    compressed.resize(deflateBound(&stream, n_bytes));
    stream.next_in   = static_cast<Bytef *>(const_cast<void *>(bytes)); // zlib only reads it
    stream.avail_in  = n_bytes;
    stream.next_out  = compressed.data();
    stream.avail_out = compressed.size();
    if (deflate(&stream, Z_FINISH) != Z_STREAM_END)
      throw std::runtime_error("no memory to compress a picture");
    compressed.resize(stream.total_out);
    return compressed;
  }



  std::string
  vtu_of(const Drawing &drawing, Compressor &compressor)
  {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                       "compressor=\"vtkZLibDataCompressor\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
    text += "<Piece NumberOfPoints=\"" + std::to_string(drawing.corners.size()) + "\" NumberOfCells=\"" +
            std::to_string(drawing.cells.size()) + "\">\n  <Points>\n";
    const auto place = [&](const std::size_t i, const std::size_t d) -> float { return drawing.corners[i].x(d); };
    add_field("Points", "m", inertial_axes, drawing.corners.size(), place, compressor, text);
    text += "  </Points>\n";
    add_cells(drawing, compressor, text);
    add_point_data(drawing, compressor, text);
    add_cell_data(drawing, compressor, text);
    return text + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }
} // namespace samara

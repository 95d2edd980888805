#include <samara/output/vtu.h>

#include <cstdint>
#include <stdexcept>

namespace samara
{
  namespace
  {
    struct Field
    {
      const char *name, *unit;
      Vector3 Sample::*value;
    };

    const Field vector_fields[] = {{"displacement", "m", &Sample::displacement},
                                   {"section force", "N", &Sample::force},
                                   {"section moment", "N m", &Sample::moment},
                                   {"strain", "1", &Sample::strain},
                                   {"curvature", "1/m", &Sample::curvature},
                                   {"velocity", "m/s", &Sample::velocity}};

    /** VTK's number for a quadrilateral whose corners go round it. */
    constexpr std::uint8_t vtk_quad = 9;



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
      for (const auto &quad : drawing.quads)
        {
          connectivity.insert(connectivity.end(), quad.begin(), quad.end());
          offsets.push_back(connectivity.size());
        }
      text += "  <Cells>\n";
      add_array("type=\"Int32\" Name=\"connectivity\"", connectivity, compressor, text);
      add_array("type=\"Int32\" Name=\"offsets\"", offsets, compressor, text);
      add_array("type=\"UInt8\" Name=\"types\"", std::vector<std::uint8_t>(drawing.quads.size(), vtk_quad), compressor, text);
      text += "  </Cells>\n";
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
    const std::size_t  n = drawing.corners.size();
    std::vector<float> vectors(3 * n), objects(n);
    std::string        text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                              "compressor=\"vtkZLibDataCompressor\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
    text += "<Piece NumberOfPoints=\"" + std::to_string(n) + "\" NumberOfCells=\"" +
            std::to_string(drawing.quads.size()) + "\">\n  <Points>\n";
    for (std::size_t i = 0; i < n; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        vectors[3 * i + d] = drawing.corners[i].x(d);
    add_array("type=\"Float32\" NumberOfComponents=\"3\"", vectors, compressor, text);
    text += "  </Points>\n";
    add_cells(drawing, compressor, text);

    text += "  <PointData>\n";
    for (const Field &field : vector_fields)
      {
        for (std::size_t i = 0; i < n; ++i)
          for (unsigned int d = 0; d < 3; ++d)
            vectors[3 * i + d] = (drawing.samples[drawing.corners[i].sample].*field.value)(d);
        add_array(std::string("type=\"Float32\" Name=\"") + field.name + "\" NumberOfComponents=\"3\" units=\"" +
                    field.unit + "\"",
                  vectors,
                  compressor,
                  text);
      }
    for (std::size_t i = 0; i < n; ++i)
      objects[i] = drawing.corners[i].object;
    add_array("type=\"Float32\" Name=\"object\"", objects, compressor, text);
    return text + "  </PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }
} // namespace samara

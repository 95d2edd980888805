#ifndef samara_output_compressor_h
#define samara_output_compressor_h

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace samara
{
  /**
   * Numbers as complete streams of zlib (RFC 1950), which any reader of them inflates. One object serves for many
   * arrays: setting up a stream of the library costs more than to compress a small one.
   *
   * Arrays of pictures are of three kinds, and each is compressed in the way that costs least:
   *
   *     values that come several times in a row     the value and "so many times more" in fixed Huffman codes (RFC
   *                                                 1951, 3.2.6), without a search for what is repeated
   *     what the library makes hardly smaller       as it is, in stored blocks; a part of it is tried
   *     all else                                    by the library, at its best speed
   */
  class Compressor
  {
  public:
    /** @throws std::runtime_error if there is no memory. */
    Compressor();
    ~Compressor();
    Compressor(const Compressor &)            = delete;
    Compressor &operator=(const Compressor &) = delete;

    /**
     * The stream, until the next call, of @p n_values values of @p size bytes each; one that comes twice in a row is
     * compared by its bytes. @throws std::runtime_error if there is no memory.
     */
    const std::vector<unsigned char> &operator()(const void *values, std::size_t n_values, std::size_t size);

    /** The same of values of which each comes times[i] times in a row; of at most 64 bytes each. */
    const std::vector<unsigned char> &
    repeated(const void *values, const std::vector<unsigned int> &times, std::size_t size);

    /** The same in stored blocks, whatever the library would make of them. */
    const std::vector<unsigned char> &as_they_are(const void *values, std::size_t n_bytes);

  private:
    z_stream                   stream{};
    std::vector<unsigned char> compressed;

    void deflate_bytes(const unsigned char *bytes, std::size_t n_bytes);
    bool shrinks(const unsigned char *bytes, std::size_t n_bytes);
    void store(const unsigned char *bytes, std::size_t n_bytes);
    /** Whether runs are long enough. */
    bool write_runs(const unsigned char *bytes, std::size_t n_values, std::size_t size);
  };



  /** Add the bytes as base64 (RFC 4648). */
  void add_base64(const unsigned char *bytes, std::size_t n, std::string &text);
} // namespace samara

#endif

#ifndef samara_report_array_stream_h
#define samara_report_array_stream_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace samara
{
  /** @p text as a JSON string with its quotes; "<" as an escape, so that no text can end an element of a page early. */
  std::string json_text(const std::string &text);

  /** A finite number with all its digits; null for others, which JSON does not know. */
  std::string json_number(double number);

  /**
   * Arrays of numbers, one behind the other, to be deflated as one stream. Of each number the bytes of equal weight
   * stand together: those of high weight hardly change, and shrink to little.
   *
   * Who adds an array gets JSON that says where it is: {"k":"f4","s":[rows,columns],"o":offset}; kinds are f4, f8, i2,
   * u1, u4, the little end first.
   */
  class ArrayStream
  {
  public:
    /** @{ */
    std::string add(const std::vector<float> &values, const std::vector<std::size_t> &shape);
    std::string add(const std::vector<double> &values, const std::vector<std::size_t> &shape);
    std::string add(const std::vector<std::int16_t> &values, const std::vector<std::size_t> &shape);
    std::string add(const std::vector<std::uint8_t> &values, const std::vector<std::size_t> &shape);
    std::string add(const std::vector<std::uint32_t> &values, const std::vector<std::size_t> &shape);
    /** @} */

    /**
     * Two bytes a number, each column within its own range: at most 8e-6 of that range is lost. Columns whose step is
     * larger than that of @p largest_steps (none: any will do) have a third byte. Rows stand one behind the other; all
     * values are finite. JSON: {"q":...,"low":...,"step":...}, value = low + step (q + 32768), column behind column;
     * where columns have a third byte also {"fine":...,"of":...}, numbers of 1/256 step and the columns they belong to.
     */
    std::string add_packed(const std::vector<float> &values,
                           std::size_t               n_rows,
                           std::size_t               n_columns,
                           const std::vector<float> &largest_steps = {});

    /** A stream of zlib (RFC 1950). @throws std::runtime_error if there is no memory */
    std::string deflated() const;

    std::size_t
    size() const
    {
      return bytes.size();
    }

  private:
    /** Bytes of one weight of one array. */
    struct Piece
    {
      std::size_t end;
      bool        may_be_noise;
    };
    std::string        bytes;
    std::vector<Piece> pieces;

    template <typename Number>
    std::string append(const char *kind, const std::vector<Number> &values, const std::vector<std::size_t> &shape);
  };
} // namespace samara

#endif

#ifndef samara_output_fifteen_digits_h
#define samara_output_fifteen_digits_h

namespace samara
{
  /**
   * Write @p number as std::to_chars does in its general form with 15 digits, the same characters in a third of the
   * time, and return their end. @p to has room for 40 of them.
   *
   * Null, and nothing that counts is written, where another way is needed: of zero, of numbers that are not finite or
   * outside of 1e-38 … 1e40, of those too near to the middle of two decimal ones for 64 bits to tell, and where the
   * processor has no numbers of 64 bits.
   */
  char *write_fifteen_digits(double number, char *to);
} // namespace samara

#endif

#ifndef samara_tests_debug_h
#define samara_tests_debug_h

/**
 * Whether every Assert is looked at, which makes programs ten times as slow. Tests that take the same paths through the
 * code for many numbers do so for fewer then; release takes them all.
 */
#ifdef NDEBUG
constexpr bool is_debug = false;
#else
constexpr bool is_debug = true;
#endif

#endif

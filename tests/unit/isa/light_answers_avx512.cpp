#if defined(__x86_64__)
#define LANES_AVX512
#include "unit/light_answers.h"

void light_questions::avx512(const Questions& in, Answers& out) { kernels::avx512::answer(in, out); }
#endif

#if defined(__x86_64__)
#define LANES_AVX2
#include "unit/light_answers.h"

void light_questions::avx2(const Questions& in, Answers& out) { kernels::avx2::answer(in, out); }
#endif

#if defined(__x86_64__)
#define LANES_SSE
#include "unit/light_answers.h"

void light_questions::sse(const Questions& in, Answers& out) { kernels::sse::answer(in, out); }
#endif

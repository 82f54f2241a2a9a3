/* budget.c: see budget.h. */
#include "base/budget.h"

#include <math.h>
#include <stdint.h>

#include "base/os.h"

struct budget budget_new(double limit, const char *advice)
{
    const double share = 0.75, fallback = 4e9, most = (double)(SIZE_MAX / 2); /* of which arrays can be */
    double machine = os_memory();
    double usual = machine > 0 ? share * machine : fallback;
    return (struct budget){fmin(limit > 0 ? limit : usual, most), 0, advice};
}

bool budget_has(const struct budget *b, double bytes, struct error *err)
{
    return b->taken + bytes <= b->limit ||
           error_set(err, "this needs %.1f MB more memory, but %.1f of %.1f MB are left%s", 1e-6 * bytes,
                     1e-6 * (b->limit - b->taken), 1e-6 * b->limit, b->advice);
}

bool budget_take(struct budget *b, double bytes, struct error *err)
{
    if (!budget_has(b, bytes, err))
        return false;
    b->taken += bytes;
    return true;
}

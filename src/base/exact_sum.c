/* exact_sum.c: see exact_sum.h. */
#include "base/exact_sum.h"

#include <math.h>

static const double BASE = 0x1p24, LIMIT = 0x1p144;

/* [top] 1 / the unit of the highest digit. */
static const double SCALE[EXACT_PLACES] = {0x1p168, 0x1p144, 0x1p120, 0x1p96,  0x1p72,  0x1p48,  0x1p24,
                                           1,       0x1p-24, 0x1p-48, 0x1p-72, 0x1p-96, 0x1p-120};

/* Move the places up; the lowest digits go. */
static void raise_top(struct exact_sum *s, int top)
{
    int by = top - s->top;
    for (int i = EXACT_DIGITS - 1; by > 0 && i >= 0; i--)
        s->digit[i] = i >= by ? s->digit[i - by] : 0;
    s->top = top;
}

void exact_add(struct exact_sum *s, double term)
{
    double size = fabs(term);
    int top = s->top;
    if (!(size < LIMIT))
        return;
    while (size * SCALE[top] >= BASE) /* ends: LIMIT is the last place's */
        top++;
    if (top > s->top)
        raise_top(s, top);
    double rest = term * SCALE[top];
    for (int i = 0; i < EXACT_DIGITS && rest != 0; i++) {
        int64_t digit = (int64_t)rest; /* below BASE; the part behind the point is cut off */
        s->digit[i] += digit;
        rest = (rest - (double)digit) * BASE; /* exact */
    }
}

/* Sums of sums end here, far enough from overflow for as many terms more as a render can have. */
static const int64_t MOST = (int64_t)1 << 62;

static bool add_fits(int64_t a, int64_t b) { return b > 0 ? a <= MOST - b : a >= -MOST - b; }

bool exact_join(struct exact_sum *s, const struct exact_sum *other)
{
    struct exact_sum a = *s, b = *other;
    raise_top(a.top < b.top ? &a : &b, a.top < b.top ? b.top : a.top);
    for (int i = 0; i < EXACT_DIGITS; i++) {
        if (!add_fits(a.digit[i], b.digit[i]))
            return false;
        a.digit[i] += b.digit[i];
    }
    *s = a;
    return true;
}

double exact_value(const struct exact_sum *s)
{
    double value = 0;
    for (int i = EXACT_DIGITS - 1; i >= 0; i--)
        value = value / BASE + (double)s->digit[i];
    return value / SCALE[s->top];
}

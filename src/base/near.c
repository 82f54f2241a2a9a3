/* near.c: see near.h. */
#include "base/near.h"

#include <ctype.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int names_find(const char *const *names, const char *name)
{
    for (int i = 0; names[i] != NULL; i++)
        if (strcmp(names[i], name) == 0)
            return i;
    return -1;
}

const char *names_list(const char *const *names, char text[NAMES_TEXT])
{
    text[0] = '\0';
    for (int i = 0; names[i] != NULL; i++) {
        size_t used = strlen(text);
        const char *join = i == 0 ? "" : names[i + 1] == NULL ? " or " : ", ";
        snprintf(text + used, NAMES_TEXT - used, "%s\"%s\"", join, names[i]);
    }
    return text;
}

static int least(int a, int b) { return a < b ? a : b; }

/* The length of a name, NEAR_LONGEST + 1 if it is longer than NEAR_LONGEST. */
static int length_of(const char *name)
{
    int n = 0;
    while (n <= NEAR_LONGEST && name[n] != '\0')
        n++;
    return n;
}

/* Letters to be changed, left out or put in where a, of n letters, is to become b, of m: row i of the table of all
 * beginnings of both is made of row i - 1. */
static int distance(const char *a, int n, const char *b, int m)
{
    int row[NEAR_LONGEST + 1];
    for (int j = 0; j <= m; j++)
        row[j] = j;
    for (int i = 1; i <= n; i++) {
        int before = row[0]; /* of row i - 1, column j - 1 */
        row[0] = i;
        for (int j = 1; j <= m; j++) {
            int changed = before + (tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]));
            before = row[j];
            row[j] = least(changed, 1 + least(row[j], row[j - 1]));
        }
    }
    return row[m];
}

struct near near_start(const char *wanted)
{
    int n = length_of(wanted);
    return (struct near){wanted, NULL, n, n < 3 ? 0 : n < 6 ? 1 : 2, ""};
}

void near_try(struct near *near, const char *name)
{
    int n = near->length, m = name != NULL ? length_of(name) : 0;
    if (n == 0 || m == 0 || n > NEAR_LONGEST || m > NEAR_LONGEST || abs(n - m) > near->most)
        return;
    int d = distance(near->wanted, n, name, m);
    if (d > near->most)
        return;
    near->most = d - 1;
    near->name = name;
    snprintf(near->text, sizeof near->text, "; did you mean \"%s\"?", name);
}

struct near near_of(const char *wanted, const char *const *names)
{
    struct near near = near_start(wanted);
    while (*names != NULL)
        near_try(&near, *names++);
    return near;
}

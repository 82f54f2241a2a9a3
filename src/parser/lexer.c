/* lexer.c: see lexer.h. */
#include "parser/lexer.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void lexer_enter(struct lexer *l, struct source_file *file)
{
    struct lexer *outer = NULL;
    if (l->file != NULL) {
        outer = arena_alloc(l->arena, sizeof *outer);
        *outer = *l;
    }
    int depth = outer != NULL ? outer->depth + 1 : 0;
    *l = (struct lexer){file, file->text, file->text, 1, depth, outer, l->arena, l->messages};
}

void lexer_leave(struct lexer *l)
{
    free(l->file->text);
    if (l->outer != NULL)
        *l = *l->outer;
    else
        l->file = NULL;
}

static struct source_position position_of(const struct lexer *l, const char *at)
{
    return (struct source_position){l->file, l->line, (int)(at - l->line_start) + 1};
}

/* CR LF ends a line once. */
static bool ends_line(const char *p) { return *p == '\n' || (*p == '\r' && p[1] != '\n'); }

static void skip_line(struct lexer *l)
{
    while (!ends_line(l->at) && l->at < l->file->end)
        l->at++;
}

/* To the first character of the next token. Every file text ends in a zero byte, which stops all loops. */
static void skip_blanks(struct lexer *l)
{
    for (;;) {
        if (ends_line(l->at)) {
            l->line++;
            l->line_start = ++l->at;
        } else if (*l->at == ' ' || *l->at == '\t' || *l->at == '\r') {
            l->at++;
        } else if (*l->at == '#') {
            skip_line(l);
        } else if (*l->at == '\0' && l->at == l->file->end && l->outer != NULL) {
            lexer_leave(l);
        } else {
            return;
        }
    }
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }
static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/* Characters that may follow a number or a word. */
static bool is_separator(char c)
{
    return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\0' || c == '[' || c == ']' || c == '"' || c == '#';
}

/* Read a number at p; returns its end, p if there is none that is finite. As in pbrt-v3 it may be hexadecimal. */
static const char *scan_number(const char *p, double *out)
{
    char *end;
    *out = strtod(p, &end);
    return isfinite(*out) ? end : p;
}

bool lexer_number(struct lexer *l, double *out)
{
    skip_blanks(l);
    const char *end = scan_number(l->at, out);
    if (end == l->at || !is_separator(*end))
        return false;
    l->at = end;
    return true;
}

static bool next_number(struct lexer *l, struct token *out)
{
    const char *odd = scan_number(l->at, &out->number), *end = odd;
    while (!is_separator(*end))
        end++;
    int shown = end - odd < 40 ? (int)(end - odd) : 40;
    if (odd == l->at)
        return source_error(l->messages, out->position, "'%.*s' is not a number, or beyond 1.7e308; write it like 12, "
                            "-0.5 or 1.5e-3", shown, odd);
    if (end > odd)
        source_warn(l->messages, position_of(l, odd), "'%.*s' directly after a number is passed over, as in pbrt-v3; "
                    "separate numbers by blanks", shown, odd);
    l->at = end;
    return true;
}

static char *copy(struct lexer *l, const char *begin, const char *end)
{
    size_t n = (size_t)(end - begin);
    char *text = arena_alloc(l->arena, n + 1);
    memcpy(text, begin, n);
    text[n] = '\0';
    return text;
}

static bool next_string(struct lexer *l, struct token *out)
{
    const char *end = l->at + 1;
    while (*end != '"' && !ends_line(end) && *end != '\0')
        end++;
    if (*end != '"')
        return source_error(l->messages, out->position, "this string does not end on its line; close it with \"");
    out->text = copy(l, l->at + 1, end);
    l->at = end + 1;
    return true;
}

enum token_kind lexer_peek(struct lexer *l)
{
    skip_blanks(l);
    char c = *l->at;
    if (c == '\0' && l->at >= l->file->end)
        return TOKEN_END;
    if (c == '"')
        return TOKEN_STRING;
    if (c == '[')
        return TOKEN_OPEN;
    if (c == ']')
        return TOKEN_CLOSE;
    return is_digit(c) || c == '-' || c == '+' || c == '.' ? TOKEN_NUMBER : TOKEN_WORD;
}

static bool next_word(struct lexer *l, struct token *out)
{
    const char *end = l->at;
    while (is_letter(*end) || is_digit(*end))
        end++;
    if (end == l->at || !is_separator(*end))
        return source_error(l->messages, position_of(l, end), "a %s that has no meaning here; remove it",
                            strncmp(end, "\xEF\xBB\xBF", 3) == 0 ? "byte order mark" : "character");
    out->text = copy(l, l->at, end);
    l->at = end;
    return true;
}

static bool next_token(struct lexer *l, struct token *out)
{
    switch (out->kind) {
    case TOKEN_END: return true;
    case TOKEN_OPEN:
    case TOKEN_CLOSE: l->at++; return true;
    case TOKEN_STRING: return next_string(l, out);
    case TOKEN_NUMBER: return next_number(l, out);
    case TOKEN_WORD: return next_word(l, out);
    }
    return false;
}

bool lexer_next(struct lexer *l, struct token *out)
{
    out->kind = lexer_peek(l);
    out->text = "";
    out->number = 0;
    out->position = position_of(l, l->at);
    if (next_token(l, out))
        return true;
    skip_line(l);
    return false;
}

void lexer_resume(struct lexer *l)
{
    struct token t;
    while (lexer_peek(l) != TOKEN_END && !(*l->at >= 'A' && *l->at <= 'Z'))
        lexer_next(l, &t);
}

const char *token_text(const struct token *t, char *buffer, size_t size)
{
    switch (t->kind) {
    case TOKEN_END: snprintf(buffer, size, "the end of the file"); break;
    case TOKEN_OPEN: snprintf(buffer, size, "["); break;
    case TOKEN_CLOSE: snprintf(buffer, size, "]"); break;
    case TOKEN_STRING: snprintf(buffer, size, "\"%.40s\"", t->text); break;
    case TOKEN_NUMBER: snprintf(buffer, size, "%.9g", t->number); break;
    case TOKEN_WORD: snprintf(buffer, size, "%.40s", t->text); break;
    }
    return buffer;
}

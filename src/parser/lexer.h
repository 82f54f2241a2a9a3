/* lexer.h: a scene file as a row of tokens: words, quoted strings, numbers and brackets.
 *
 * Blanks and comments (from # to the end of the line) separate tokens; brackets and quotes may touch their
 * neighbours.
 * Tests: test_parser.c. */
#ifndef ASBDPT_LEXER_H
#define ASBDPT_LEXER_H

#include <stdbool.h>

#include "base/mem.h"
#include "parser/source_position.h"

enum token_kind { TOKEN_END, TOKEN_WORD, TOKEN_STRING, TOKEN_NUMBER, TOKEN_OPEN, TOKEN_CLOSE };

struct token {
    enum token_kind kind;
    const char *text;   /* word or string (without quotes), zero-terminated; else "" */
    double number;      /* of TOKEN_NUMBER, finite */
    struct source_position position; /* of its first character */
};

/* A position in a file. Copy it to look ahead. */
struct lexer {
    const struct source_file *file;
    const char *at;         /* next character */
    const char *line_start; /* of the line `at` is in */
    int line;
    struct arena *arena;        /* where texts of tokens live */
    struct messages *messages;
};

/* lexer_start: at the beginning of a file. All three must outlive the lexer and its copies; the texts of tokens live as
 * long as the arena. */
struct lexer lexer_start(const struct source_file *file, struct arena *arena, struct messages *messages);

/* lexer_next: take one token. False with a message on an unterminated string, an unknown character, or a
 * malformed or too large number; the rest of the line is then passed over. At the end of the file: TOKEN_END, again and
 * again. lexer_peek: the kind of the next token, judged by its first character, without taking it. */
bool lexer_next(struct lexer *l, struct token *out);
enum token_kind lexer_peek(struct lexer *l);

/* lexer_number: a fast path for long lists: take a number and return true, or take nothing, also where it is
 * malformed. */
bool lexer_number(struct lexer *l, double *out);

/* lexer_resume: after an error, pass over what is no directive: those are words that begin with a capital letter. */
void lexer_resume(struct lexer *l);

/* token_text: what the user wrote, for messages: a number, word or string in quotes, a bracket or "the end of the
 * file". The buffer should have 64 bytes; long ones are cut. */
const char *token_text(const struct token *t, char *buffer, size_t size);

#endif

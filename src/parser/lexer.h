/* lexer.h: a scene as a row of tokens: words, quoted strings, numbers and brackets.
 *
 * Blanks and comments (from # to the end of the line) separate tokens; brackets and quotes may touch their
 * neighbours. Lines end in LF, CR LF or CR. An included file is a part of the row: behind its last token comes the next
 * one of the file that includes it, as in pbrt-v3.
 * Tests: test_parser.c. */
#ifndef ASBDPT_LEXER_H
#define ASBDPT_LEXER_H

#include <stdbool.h>

#include "base/mem.h"
#include "parser/messages.h"

enum token_kind { TOKEN_END, TOKEN_WORD, TOKEN_STRING, TOKEN_NUMBER, TOKEN_OPEN, TOKEN_CLOSE };

struct token {
    enum token_kind kind;
    const char *text;   /* word or string (without quotes), zero-terminated; else "" */
    double number;      /* of TOKEN_NUMBER, finite */
    struct source_position position; /* of its first character */
};

/* A position in a file. */
struct lexer {
    struct source_file *file; /* NULL: none is entered */
    const char *at;           /* next character */
    const char *line_start;   /* of the line `at` is in */
    int line;
    int depth;           /* files that this one is included in */
    struct lexer *outer; /* the position behind the Include; NULL at depth 0 */
    struct arena *arena; /* where texts of tokens live */
    struct messages *messages;
};

/* lexer_enter: to the beginning of a file, whose text the lexer takes over; its end leads back to where the lexer is.
 * file, arena and messages must outlive the lexer; texts of tokens live as long as the arena. lexer_leave: pass over
 * the rest of the file. */
void lexer_enter(struct lexer *l, struct source_file *file);
void lexer_leave(struct lexer *l);

/* lexer_next: take one token. False with a message on an unterminated string, an unknown character, or what is no
 * number, or too large; the rest of the line is then passed over. At the end of the main file: TOKEN_END, again and
 * again. lexer_peek: the kind of the next token, judged by its first character, without taking it. */
bool lexer_next(struct lexer *l, struct token *out);
enum token_kind lexer_peek(struct lexer *l);

/* lexer_number: a fast path for long lists: take a number and return true, or take nothing, also where something
 * follows it directly. */
bool lexer_number(struct lexer *l, double *out);

/* lexer_resume: after an error, pass over what is no directive: those are words that begin with a capital letter. */
void lexer_resume(struct lexer *l);

/* token_text: what the user wrote, for messages: a number, word or string in quotes, a bracket or "the end of the
 * file". The buffer should have 64 bytes; long ones are cut. */
const char *token_text(const struct token *t, char *buffer, size_t size);

#endif

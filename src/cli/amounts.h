/* Areas, volumes and flows as plain decimals, or, of what is too small for these, in scientific notation. */
#ifndef CLI_AMOUNTS_H
#define CLI_AMOUNTS_H

enum { CLI_AMOUNT = 352 }; /* the longest double with a few decimals */

/* With the decimals that tell `whole`, of which the amount is a part or which it is: `least`, or as many more as leave
 * `digits` significant digits of it. */
void cli_amount_text(double amount, double whole, int least, int digits, char text[CLI_AMOUNT]);

#endif

/* A program without a console that runs until its standard input ends. */
#include <stdio.h>

int main(void)
{
    puts("ready");
    fflush(stdout);
    while (getchar() != EOF)
    {
    }
    return 0;
}

# Every target lives in Code/Makefile; this file only lets you call them from the top folder.
.DEFAULT_GOAL := all
.PHONY: all force
all:
	@$(MAKE) --no-print-directory -C Code all
%: force # what is there as a file, too: Code/Makefile knows what it is made of
	@$(MAKE) --no-print-directory -C Code $@
Makefile force: ;

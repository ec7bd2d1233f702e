def thesis_page(results):
    return "x"

!> What the program says of itself, without a case: help, keys, results, and case files to begin
!> with, that have every key of an analysis with unit, default and meaning.
module gfb_information
  use gfb_errors, only: error_type, fail
  use gfb_key_book, only: key_type, no_default
  use gfb_result_names, only: find_result, result_words, row_names, results_text
  use gfb_result_table, only: result_type
  use gfb_scene_reading, only: all_keys, key_table
  use gfb_text, only: lower_case, nearest_word, did_you_mean, plain_text, join
  use gfb_command_line, only: command_line_type, help_text
  use gfb_field_words, only: field_word_type, find_field_word, field_word_rows, first_word
  use gfb_meaning_search, only: found_by_meaning
  use gfb_provenance, only: version_text
  use gfb_case_keys, only: case_keys_type
  use gfb_run_case, only: read_input
  use gfb_scene, only: scene_type, read_groups
  use gfb_analysis_row, only: analysis_rows, analysis_examples, analysis_example_type, &
                              analysis_equilibrium, analysis_linear_dynamics
  implicit none (type, external)
  private
  public :: information

  !> Of `--template`, beside the analyses: an equilibrium of a thrust bearing, and a machine.
  character(len=*), parameter :: more_templates(*) = [character(len=7) :: 'thrust', 'machine']
  type(analysis_example_type), parameter :: thrust_example = analysis_example_type( &
    ' feed shaft_contact sweep sensitivity accuracy ', &
    "&bearing kind='thrust' outer_radius=50.0e-3 inner_radius=25.0e-3 / "// &
    '&pads count=6 arc=0.785 / &ramp part=0.5 height=20.0e-6 / '// &
    '&gas viscosity=1.85e-5 ambient_pressure=1.01325e5 / '// &
    "&feed kind='orifices' supply_pressure=6.0e5 orifice_diameter=0.2e-3 orifices=2 "// &
    'row_positions=37.5e-3 / '// &
    '&operation speed_rpm=40000.0 axial_load=150.0 / '// &
    "&model foil='elastic_foundation' foundation_stiffness=10.0e9 "// &
    "foundation_pressure='radial_mean' / &shaft_contact roughness=0.5e-6 pressure=10.0e6 / "// &
    "&sweep parameter='axial_load' values=150.0, 170.0, 190.0 / "// &
    "&sensitivity quantity='axial_gap' parameters='ramp%height', 'gas%viscosity' "// &
    "tolerances=1.0e-6, 2.0e-7 / &accuracy quantity='axial_gap' /")
  !> The template of an equilibrium is its bearing.
  type(analysis_example_type), parameter :: machine_example = analysis_example_type( &
    ' loads sweep ', &
    '&shaft lengths=0.04, 0.24, 0.04 outer_diameters=38.1e-3, 36.0e-3, 38.1e-3 '// &
    'youngs_modulus=211.0e9 poissons_ratio=0.3 density=7850.0 / '// &
    '&discs positions=0.14, 0.18 masses=6.0 polar_inertias=0.01 / '// &
    "&bearings files='bearing.nml', 'bearing.nml' positions=0.02, 0.30 / "// &
    '&machine speed_rpm=20000.0 / &dynamics largest_frequency=3500.0 / '// &
    '&unbalance positions=0.14 values=2.0e-6 / &loads positions=0.16 forces_x=-100.0 / '// &
    "&sweep parameter='speed_rpm' values=20000.0, 22000.0, 24000.0 /")
  character(len=*), parameter :: template_words(*) = [analysis_rows%word, [character(len= &
                                 len(analysis_rows%word)) :: more_templates]]
  character(len=*), parameter :: of_machine = '! Its bearings have a case file of their own: '// &
    'gfb --template equilibrium --short > bearing.nml'//new_line('a')
  integer, parameter :: comment_column = 42, longest_line = 120 !! of a template
  integer, parameter :: longest_short_line = 100
  character(len=1), parameter :: next = new_line('a')
  integer, parameter :: longest_name = 64
  character(len=*), parameter :: all_topics = 'topics' !! of `--explain`

contains

  !> All that is known of a word: keys of that name, keys of the group, the result, keys that take
  !> it as their value, and where the field's word leads; where it is none of these, all whose
  !> meanings have it.
  !>
  !> Fails with the names that are near where there is none.
  subroutine explanation(asked, words, error)
    character(len=*), intent(in) :: asked !! as typed
    character(len=:), allocatable, intent(out) :: words !! to be printed
    type(error_type), allocatable, intent(out) :: error !! why nothing is known
    type(key_type), allocatable :: keys(:)
    type(result_type) :: row
    character(len=:), allocatable :: name
    integer :: i

    name = lower_case(trim(asked))
    if (index(name, '&') == 1) name = name(2:)
    keys = all_keys()
    words = ''
    do i = 1, size(keys)
      if (keys(i)%group == name) words = words//key_line(keys(i))
    end do
    if (words /= '') words = '&'//name//' has the keys'//next//words
    do i = 1, size(keys)
      if (name == keys(i)%name .or. name == trim(keys(i)%group)//'%'//trim(keys(i)%name)) then
        words = words//key_words(keys(i))
      end if
    end do
    call find_result(name, row)
    if (row%name /= '') words = words//result_words(name)
    do i = 1, size(keys)
      if (index(keys(i)%type_words, "'"//name//"'") > 0) then
        words = words//value_words(name, keys(i))
      end if
    end do
    words = words//field_words(find_field_word(name))
    if (name == all_topics) words = words//topic_list()
    if (words == '') then
      words = found_by_meaning(name, keys)
      if (words /= '') words = trim(asked)//' is no name of gfb; what has it in its meaning:'// &
                               next//words
    end if
    if (words /= '') then
      words = words(:len(words) - 1)
    else
      call fail(error, 'gfb: there is no key, group or result '//trim(asked)//near(name, keys)// &
                '; gfb --keys, gfb --results and gfb --explain topics have all')
    end if
  end subroutine explanation

  !> A key on one line.
  pure function key_line(one) result(words)
    type(key_type), intent(in) :: one
    character(len=:), allocatable :: words

    words = '  '//trim(one%name)
    if (one%unit /= '' .and. one%unit /= '1') words = words//' ['//one%unit//']'
    words = words//': '//plain_text(one%meaning)//next
  end function key_line

  !> All that is known of a key.
  pure function key_words(one) result(words)
    type(key_type), intent(in) :: one
    character(len=:), allocatable :: words

    words = 'key '//trim(one%name)//' of &'//trim(one%group)//next// &
            '  meaning  '//plain_text(one%meaning)//next// &
            '  value    '//plain_text(one%type_words)//next
    if (one%unit /= '' .and. one%unit /= '1') then
      words = words//'  unit     '//one%unit//next
    end if
    if (one%shown_default == no_default) then
      words = words//'  default  none'//next
    else
      words = words//'  default  '//plain_text(one%shown_default)//next
    end if
  end function key_words

  !> A value that a key takes.
  pure function value_words(value, one) result(words)
    character(len=*), intent(in) :: value
    type(key_type), intent(in) :: one
    character(len=:), allocatable :: words

    words = "value '"//value//"' of "//trim(one%name)//' in &'//trim(one%group)//next// &
            '  meaning  '//plain_text(one%meaning)//next
    if (one%shown_default /= no_default) then
      words = words//'  default  '//plain_text(one%shown_default)//next
    end if
  end function value_words

  !> Where a word of the field leads; empty where it is none.
  pure function field_words(row) result(words)
    type(field_word_type), intent(in) :: row
    character(len=:), allocatable :: words

    words = ''
    if (row%words == '') return
    words = 'topic '//first_word(row)//next//'  meaning  '//trim(row%meaning)//next
    if (row%keys /= '') words = words//'  keys     '//trim(row%keys)//next
    if (row%results /= '') words = words//'  results  '//trim(row%results)//next
    if (row%analysis /= '') then
      words = words//'  begin    gfb --template '//first_word(row)//' --short'//next
    end if
    words = words//'  manual   docs/manual/'//trim(row%page)//'.md'//next
  end function field_words

  !> All words of the field that are known, those that lead to the same on one line.
  pure function topic_list() result(words)
    character(len=:), allocatable :: words
    type(field_word_type), allocatable :: rows(:)
    integer :: i

    rows = field_word_rows()
    words = ''
    do i = 1, size(rows)
      words = words//trim(rows(i)%words)//next
    end do
  end function topic_list

  !> The names that are nearest to an unknown one, as a question.
  pure function near(name, keys) result(words)
    character(len=*), intent(in) :: name
    type(key_type), intent(in) :: keys(:)
    character(len=:), allocatable :: words
    character(len=longest_name) :: full(size(keys)), short(size(keys))
    character(len=:), allocatable :: found(:)
    integer :: i

    do i = 1, size(keys)
      full(i) = trim(keys(i)%group)//'%'//trim(keys(i)%name)
      short(i) = keys(i)%name
    end do
    found = [character(len=longest_name) :: nearest_word(name, full), nearest_word(name, short), &
             nearest_word(name, row_names()), nearest_field_word(name)]
    words = ''
    do i = 1, size(found)
      if (found(i) == '' .or. any(found(:i - 1) == found(i))) cycle
      if (words /= '') words = words//' or '
      words = words//trim(found(i))
    end do
    words = did_you_mean(words)
  end function near

  !> The field's word that is nearest to an unknown one; empty where none is.
  pure function nearest_field_word(name) result(nearest)
    character(len=*), intent(in) :: name
    character(len=:), allocatable :: nearest
    type(field_word_type), allocatable :: rows(:)
    character(len=longest_name), allocatable :: titles(:)
    integer :: i

    rows = field_word_rows()
    allocate (titles(size(rows)))
    do i = 1, size(rows)
      titles(i) = first_word(rows(i))
    end do
    nearest = nearest_word(name, titles)
  end function nearest_field_word

  !> The text that is asked for; empty where a case is to be computed.
  !>
  !> Fails where nothing is known of what is asked for.
  subroutine information(line, words, error)
    type(command_line_type), intent(in) :: line !! what was typed
    character(len=:), allocatable, intent(out) :: words !! to be printed
    type(error_type), allocatable, intent(out) :: error !! why there is none
    character(len=:), allocatable :: text, name !! of a case file

    words = ''
    if (line%help) then
      words = help_text()
    else if (line%version) then
      words = version_text()
    else if (line%keys) then
      if (allocated(line%case_file)) then
        call read_input(line%case_file, text, name, error)
        if (.not. allocated(error)) words = key_table(text)
      else
        words = key_table()
      end if
    else if (line%results) then
      words = results_text()
    else if (line%template /= '') then
      call template_text(line%template, line%short, words, error)
    else if (line%explain /= '') then
      call explanation(line%explain, words, error)
    end if
  end subroutine information

  !> The case file of an analysis, or of a word of the field, with which it can begin: run as it
  !> is, it has an answer.
  !>
  !> Fails where there is no such analysis.
  subroutine template_text(asked, short, words, error)
    character(len=*), intent(in) :: asked !! as typed
    logical, intent(in) :: short !! only what the case needs
    character(len=:), allocatable, intent(out) :: words !! of the file
    type(error_type), allocatable, intent(out) :: error !! why there is none
    type(case_keys_type) :: keys
    type(scene_type) :: scene
    type(analysis_example_type) :: example
    type(field_word_type) :: topic
    character(len=:), allocatable :: analysis, hint, word
    integer :: number

    words = ''
    analysis = asked
    if (all(template_words /= asked)) then
      topic = find_field_word(asked)
      if (topic%analysis /= '') analysis = trim(topic%analysis)
    end if
    number = findloc(template_words == analysis, .true., 1)
    if (number == 0) then
      hint = did_you_mean(nearest_word(analysis, template_words))
      if (hint == '') hint = '.'
      call fail(error, 'gfb: --template '//analysis//': there is no such analysis'//hint// &
                ' The analyses are '//join(template_words, ', '))
      return
    end if
    if (number <= size(analysis_rows)) then
      word = trim(analysis)
      example = analysis_examples(number)
    else if (analysis == 'thrust') then
      word = trim(analysis_equilibrium%word)
      example = thrust_example
    else
      word = trim(analysis_linear_dynamics%word)
      example = machine_example
    end if
    if (topic%groups /= '') call want_groups(example, topic%groups)
    call keys%open_text("&scene title='my first case' analysis='"//word//"' /"// &
                        trim(example%text), 'template')
    call read_groups(keys, scene)
    if (short) then
      words = short_text(keys%book%keys(:keys%book%count), example)
      if (analysis == 'machine') words = of_machine//words
      return
    end if
    words = '! A case file of gfb, written by gfb --template. It can be run as it is. SI '// &
            'units.'//next// &
            '! A key in a comment shows its default; take away its ''!'' to give another '// &
            'value.'//next// &
            '! The same holds for groups in comments. gfb --check CASE.nml shows '// &
            'mistakes,'//next// &
            '! gfb --explain KEY says what a key means.'//next// &
            written(keys%book%keys(:keys%book%count), example)
    if (analysis == 'machine') words = of_machine//words
  end subroutine template_text

  !> Takes groups of an example out of those that stand in comments.
  pure subroutine want_groups(example, groups)
    type(analysis_example_type), intent(inout) :: example
    character(len=*), intent(in) :: groups
    integer :: place

    place = index(example%offered, ' '//trim(groups)//' ')
    if (place == 0) return
    example%offered = example%offered(:place)//example%offered(place + len_trim(groups) + 2:)
  end subroutine want_groups

  !> The keys that an example gives, a group a line or two, as a case file.
  pure function short_text(met, example) result(words)
    type(key_type), intent(in) :: met(:)
    type(analysis_example_type), intent(in) :: example
    character(len=:), allocatable :: words
    character(len=:), allocatable :: group, line, word
    integer :: i

    words = '! Run it: gfb CASE.nml. SI units. gfb --explain KEY says what a key is; without '// &
            '--short all keys stand here.'//next
    group = ''
    line = ''
    do i = 1, size(met)
      if (.not. (met(i)%is_echoed .and. met(i)%given)) cycle
      if (example%offers(trim(met(i)%group))) cycle
      if (met(i)%group /= group) then
        if (group /= '') words = words//line//' /'//next
        group = trim(met(i)%group)
        line = '&'//group
      end if
      word = ' '//trim(met(i)%name)//' = '//trim(met(i)%value)
      if (len(line) + len(word) > longest_short_line) then
        words = words//line//next
        line = '   '
      end if
      line = line//word
    end do
    words = words//line//' /'//next
  end function short_text

  !> The keys as a case file; the groups that are only offered stand in comments.
  pure function written(met, example) result(words)
    type(key_type), intent(in) :: met(:)
    type(analysis_example_type), intent(in) :: example
    character(len=:), allocatable :: words
    character(len=:), allocatable :: group, before
    integer :: i

    words = ''
    group = ''
    before = ''
    do i = 1, size(met)
      if (.not. met(i)%is_echoed) cycle
      if (met(i)%group /= group) then
        if (group /= '') words = words//before//'/'//next
        group = trim(met(i)%group)
        before = trim(merge('! ', '  ', example%offers(group)))
        words = words//next
        if (before /= '') words = words//'! Where it is wanted:'//next
        words = words//before//'&'//group//next
      end if
      words = words//key_lines(met(i), before)
    end do
    words = words//before//'/'//next
  end function written

  !> A key with its comment, which may need several lines.
  pure function key_lines(one, before) result(words)
    type(key_type), intent(in) :: one
    character(len=*), intent(in) :: before !! '!' in a group that is only offered
    character(len=:), allocatable :: words
    character(len=:), allocatable :: line, left
    integer :: last

    line = before//'  ! '
    if (one%given) line = before//'  '
    line = line//trim(one%name)//' ='
    if (one%given .or. one%is_set .or. one%default == '') line = line//' '//one%value
    left = comment(one)
    words = ''
    do
      if (len(line) < comment_column - 1) line = line//repeat(' ', comment_column - 1 - len(line))
      line = line//' ! '
      last = len(left)
      if (len(line) + last > longest_line) then
        last = index(left(:min(last, longest_line - len(line))), ' ', back=.true.)
        if (last == 0) last = len(left)
      end if
      words = words//line//trim(left(:last))//next
      left = left(last + 1:)
      if (left == '') exit
      line = before
    end do
  end function key_lines

  !> Unit, meaning, choice and default of a key.
  pure function comment(one) result(words)
    type(key_type), intent(in) :: one
    character(len=:), allocatable :: words

    words = ''
    if (one%unit /= '' .and. one%unit /= '1') words = '['//one%unit//'] '
    words = words//plain_text(one%meaning)
    if (index(one%type_words, '`') > 0) words = words//': '//plain_text(one%type_words)
    if (one%required) then
      words = words//' (required)'
    else if (one%default /= '' .and. one%default /= no_default) then
      words = words//' (default: '//plain_text(one%default)//')'
    else if (one%given .and. one%default == '') then
      words = words//' (default: '//plain_text(one%shown_default)//')'
    end if
  end function comment
end module gfb_information

!> The range a number of the input must lie in.
module gfb_value_rules
  use gfb_kinds, only: wp
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: rule_type, any_value, positive, not_negative, at_least, from_to, from_below, between
  public :: broken_rule

  !> A range; a side without a bound is open to all numbers.
  type :: rule_type
    private
    logical :: has_low = .false., has_high = .false.
    logical :: low_is_in = .true., high_is_in = .true. !! the bound itself is allowed
    real(wp) :: low = 0.0_wp, high = 0.0_wp
  end type rule_type

  type(rule_type), parameter :: any_value = rule_type()
  type(rule_type), parameter :: positive = rule_type(has_low=.true., low_is_in=.false.)
  type(rule_type), parameter :: not_negative = rule_type(has_low=.true.)

contains

  !> low <= value
  elemental function at_least(low) result(rule)
    real(wp), intent(in) :: low !! smallest value [its unit]
    type(rule_type) :: rule
    rule = rule_type(has_low=.true., low=low)
  end function at_least

  !> low <= value <= high
  elemental function from_to(low, high) result(rule)
    real(wp), intent(in) :: low, high !! smallest and largest value [its unit]
    type(rule_type) :: rule
    rule = rule_type(has_low=.true., has_high=.true., low=low, high=high)
  end function from_to

  !> low <= value < high
  elemental function from_below(low, high) result(rule)
    real(wp), intent(in) :: low, high !! smallest and largest value [its unit]
    type(rule_type) :: rule
    rule = rule_type(has_low=.true., has_high=.true., high_is_in=.false., low=low, high=high)
  end function from_below

  !> low < value < high
  elemental function between(low, high) result(rule)
    real(wp), intent(in) :: low, high !! smallest and largest value [its unit]
    type(rule_type) :: rule
    rule = rule_type(.true., .true., .false., .false., low, high)
  end function between

  !> What a value breaks, in words; empty where it keeps the rule.
  pure function broken_rule(rule, value) result(words)
    type(rule_type), intent(in) :: rule !! that the value keeps
    real(wp), intent(in) :: value !! [its unit] to be looked at
    character(len=:), allocatable :: words
    logical :: kept

    kept = .true.
    if (rule%has_low) kept = value > rule%low .or. (rule%low_is_in .and. .not. value < rule%low)
    if (rule%has_high .and. kept) then
      kept = value < rule%high .or. (rule%high_is_in .and. .not. value > rule%high)
    end if
    words = ''
    if (.not. kept) words = rule_words(rule)
  end function broken_rule

  !> A rule in words.
  pure function rule_words(rule) result(words)
    type(rule_type), intent(in) :: rule
    character(len=:), allocatable :: words
    character(len=:), allocatable :: low, high

    if (rule%has_low .and. .not. rule%has_high .and. .not. abs(rule%low) > 0.0_wp) then
      words = 'must be positive'
      if (rule%low_is_in) words = 'must not be negative'
      return
    end if
    low = ''
    high = ''
    if (rule%has_low) low = trim(merge('at least    ', 'greater than', rule%low_is_in))//' '// &
                            text(rule%low)
    if (rule%has_high) high = trim(merge('at most  ', 'less than', rule%high_is_in))//' '// &
                              text(rule%high)
    words = 'must be '//low
    if (rule%has_low .and. rule%has_high) words = words//' and '
    words = words//high
  end function rule_words
end module gfb_value_rules

within HydraulicTestBench.Effects.Pairs;
model SpoolOpenings "Two changes of the valve's opening, one behind the other"
  extends Interfaces.PartialSignal;
  replaceable Interfaces.Neutral.Signal first constrainedby Interfaces.PartialSignal "First effect"
    annotation(choicesAllMatching=true);
  replaceable Interfaces.Neutral.Signal second constrainedby Interfaces.PartialSignal "Second effect"
    annotation(choicesAllMatching=true);
equation
  first.s = s;
  second.s = first.y;
  y = second.y;
  annotation(__HydraulicTestBench(pair="spoolOpening"), Documentation(info="<html>
<p>The second sees what the first gives: an offset ahead of a dead band moves the band, behind it it moves the
opening.</p>
<p><b>Source:</b> this library.</p>
<p><b>Valid:</b> for any two fillings of the slot.</p>
</html>"));
end SpoolOpenings;
